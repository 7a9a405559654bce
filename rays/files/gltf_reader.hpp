// Reader of glTF 2.0, as JSON and as GLB.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "rays/files/file_mesh.hpp"
#include "rays/mesh/own_instance.hpp"

namespace hitpipe::ref {

/// The triangles of the scene that the file shows first, moved by its nodes; `file` finds the buffers. Each
/// primitive of each node is a group, with the names of its mesh and its material. Under a transform that
/// mirrors, two corners of each triangle are swapped, so that its front stays outside.
///
/// Nothing is animated. Morph targets are added with the weights of the node, or else of the mesh. A mesh
/// with a skin is moved by its joints, each where its node is; the transform of its own node is ignored, as
/// the specification says. So is its sign: a primitive is mirrored if joints mirror it and no joint that moves
/// it keeps its sides.
///
/// Skipped are points, lines, primitives without positions, other scenes, and everything about materials,
/// textures, images, cameras, lights and animations. An extension that is required must be in the list of
/// gltf_document.cpp. EXT_mesh_gpu_instancing is read; hidden nodes of KHR_node_visibility are refused. Both also
/// if they are not required.
///
/// Throws std::runtime_error, one line that names the place in the JSON. Instances of a mesh may not take
/// more memory than 32 MiB and 24 times the bytes of the file and its buffers.
[[nodiscard]] FileMesh read_gltf(std::string_view bytes, const std::filesystem::path& file);

/// Meshes without their groups, and where they are.
struct FileInstances {
  std::vector<FileMesh> meshes;
  std::vector<OwnInstance> instances;
};

/// The same scene, with each mesh once. Nodes share a mesh if it has the same weights in them. A mesh with a skin
/// lies where the skin puts it. Instances stand in the order of read_gltf()'s triangles; where one mirrors, its
/// mesh is not turned. A mesh without triangles is left out. The limit is on what is stored, not on what instances
/// stand for.
[[nodiscard]] FileInstances read_gltf_instances(std::string_view bytes, const std::filesystem::path& file);

}  // namespace hitpipe::ref
