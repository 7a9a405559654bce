// What a material of an MTL file (Wavefront 1995) means to the renderer.
#pragma once

#include <optional>

#include "sw_ref/scene/scene.hpp"

struct aiMaterial;

namespace hitpipe::ref {

/// Kd is the albedo. Ks is mirrored if `illum` asks for traced reflections (3 to 7 and 9). A part 1 - d of
/// the light passes through, coloured by Tf, and is refracted by Ni (`illum` 6 and 7; else it goes straight
/// on). Parts that add up to more than 1 are made darker together. Textures are not read. Nothing for a face
/// without a material, and for a material that no MTL file defines.
[[nodiscard]] std::optional<Material> obj_material(const aiMaterial& material);

}  // namespace hitpipe::ref
