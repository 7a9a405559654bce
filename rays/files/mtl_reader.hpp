// Reader of MTL files (Wavefront 1995), and what their materials mean to the renderer.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

/// What an MTL file says of a material, as it stands there.
struct MtlMaterial {
  std::optional<glm::vec3> diffuse;   ///< Kd
  std::optional<glm::vec3> specular;  ///< Ks
  std::optional<glm::vec3> filter;    ///< Tf
  std::optional<float> opacity;       ///< d
  std::optional<float> transparency;  ///< Tr, which the specification does not have
  std::optional<float> index;         ///< Ni
  std::optional<int> illum;

  /// d, or 1 - Tr where d is not given.
  [[nodiscard]] float opaque() const;
};
using MtlMaterials = std::map<std::string, MtlMaterial, std::less<>>;

/// Adds the materials of a text; what it says of one that is there already replaces what was said. Words
/// other than those above are skipped. A colour may be in CIE XYZ ("xyz"). A value that is not read, such as a
/// spectrum, is left out; returns the line and the reason of each. Throws std::runtime_error, one line, if the
/// text is UTF-16.
[[nodiscard]] std::vector<std::string> read_mtl(std::string_view text, MtlMaterials& materials);

/// The same for a file. A note says what is left out, since no material is worth the loss of a mesh.
void read_mtl_file(const std::filesystem::path& file, MtlMaterials& materials);

/// Kd is the albedo. Ks is mirrored if `illum` asks for traced reflections (3 to 7 and 9). A part 1 - d of
/// the light passes through, coloured by Tf, and is refracted by Ni (`illum` 6 and 7; else it goes straight on). Parts
/// that add up to more than 1 are made darker together. Textures are not read. Nothing for a material without
/// Kd, Ks, d and Tr.
[[nodiscard]] std::optional<Material> surface_of(const MtlMaterial& material);

}  // namespace hitpipe::ref
