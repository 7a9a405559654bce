// The meshes, images and rays that the testbenches of a core are made of.
#pragma once

#include <cstdint>
#include <functional>

#include "rays/image/core_image.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/scene/scene.hpp"
#include "rays/world/int_scene.hpp"
#include "rtl_gen/core/core.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

/// In the cube.
[[nodiscard]] glm::vec3 random_point(ref::adversary::Random& random);

/// Each triangle has its corners at most 2 * `size` from each other on an axis. 0 < size <= 1.
[[nodiscard]] ref::Scene random_scene(std::uint32_t triangles, float size, ref::adversary::Random& random);
/// The triangles' corners are corners of the cube. Some have no area. The first is a face of a regular
/// tetrahedron whose fourth corner is (-1, -1, -1). The second is the same face from its other side.
[[nodiscard]] ref::Scene largest_scene(std::uint32_t triangles, ref::adversary::Random& random);
[[nodiscard]] ref::Scene joined(ref::Scene scene, const ref::Scene& other);

/// Corners and origins have few places, and directions are 0 or as long as can be on each axis. So rays meet corners
/// and edges, run in planes of triangles, and tie.
class Lattice {
 public:
  /// `random` must outlive it.
  Lattice(int coord_bits, ref::adversary::Random& random);

  ref::Scene scene(std::uint32_t triangles);
  ref::Ray ray();

 private:
  [[nodiscard]] float at(int steps) const;
  glm::vec3 place();

  ref::adversary::Random& random_;
  int half_, step_;
};

/// A triangle's middle, or its first corner. A ray to a corner often meets an edge of a box.
[[nodiscard]] glm::vec3 point_of_one(const ref::IntScene& scene, ref::adversary::Random& random);

struct Traced {
  ref::IntScene scene;
  ref::CoreImage image;
};

/// The scene that is made of so many triangles, or of half as many as long as the core cannot read its image.
[[nodiscard]] Traced traced(const rtl::CoreOptions& options, std::uint32_t triangles,
                            const std::function<ref::IntScene(std::uint32_t)>& make);

/// With a hierarchy in which each branch has a leaf and the next branch, and the last two leaves. It has so many
/// branches, or as many as the triangles allow.
[[nodiscard]] ref::IntScene chained(ref::IntScene scene, int branches, ref::adversary::Random& random);

/// A triangle gets the number that is made of its own. The header stays.
[[nodiscard]] ref::CoreImage renumbered(ref::CoreImage image,
                                        const std::function<std::uint32_t(std::uint32_t)>& number);
/// Some blocks are of another kind or not there, and some records have another pointer or other children.
[[nodiscard]] ref::CoreImage damaged(ref::CoreImage image, const rtl::CoreOptions& options,
                                     ref::adversary::Random& random);

}  // namespace hitpipe::sim
