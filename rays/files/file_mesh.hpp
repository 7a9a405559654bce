// What a mesh file says, as a reader gives it: nothing is rounded, cut into triangles, joined or left out
// yet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

struct FileMesh {
  /// A number that the format calls binary32 has that value; any other is rounded to binary64 once.
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> corners;  ///< of all faces, one after the other: places in `positions`
  /// Corners of each face, in the order of the file. Empty: each face is a triangle. A face with fewer than 3
  /// corners covers nothing, but has its place.
  std::vector<std::uint32_t> sizes;

  /// Consecutive faces that have one name and one material in the file; both may be empty.
  struct Group {
    std::string name;
    std::string material;
    std::optional<Material> surface{};  ///< of an OBJ with materials: what its MTL file says
    std::size_t first_face = 0;
  };
  std::vector<Group> groups;  ///< they cover all faces; empty: one group without a name

  [[nodiscard]] std::size_t faces() const { return sizes.empty() ? corners.size() / 3 : sizes.size(); }

  void add_face(std::span<const std::uint32_t> face) {
    if (face.size() != 3 && sizes.empty()) sizes.assign(corners.size() / 3, 3);
    corners.insert(corners.end(), face.begin(), face.end());
    if (face.size() != 3 || !sizes.empty()) sizes.push_back(static_cast<std::uint32_t>(face.size()));
  }
};

}  // namespace hitpipe::ref
