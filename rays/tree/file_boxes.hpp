// Moves the boxes of a file into the cube and checks that the leaves hold the triangles of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rays/scene/scene.hpp"
#include "rays/tree/bvh_file.hpp"

namespace hitpipe::ref {

/// By how much a box may be too small, in the file's space. Two programs that read a coordinate from text may
/// round it differently. So it is four units in the last place of the mesh's largest coordinate, and 0 in
/// the cube.
[[nodiscard]] double box_tolerance(const BvhFile& file, const Scene& scene);

/// Moves every box as the scene's points are moved, rounds it outward to binary32, and cuts it to the part of
/// the cube in which the mesh lies. Boxes of the cube are taken as they are. Throws as BvhFile::reject() does
/// when such a box leaves the cube.
void move_into_cube(BvhFile& file, const Scene& scene);

/// Replaces the file's numbers of triangles by the mesh's, leaves out dropped triangles, and then takes
/// leaves without triangles out of their branches. Boxes that are too small by at most `tolerance`, in the
/// cube, are grown; returns how many. A triangle may stick out of its leaf if all its leaves together hold
/// it. `from_root` are the nodes, parents before children. Throws as BvhFile::reject() does when boxes do not
/// hold a triangle, and std::runtime_error, one line, for a triangle in no leaf.
[[nodiscard]] std::size_t fit_to_triangles(BvhFile& file, const Scene& scene, double tolerance,
                                           std::span<const std::uint32_t> from_root);

}  // namespace hitpipe::ref
