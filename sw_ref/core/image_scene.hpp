// A scene again from the image of a core. An image has triangles and their numbers, and its cube; so the scene has
// one plain material and flat surfaces.
#pragma once

#include <string>

#include "hls/world/world_format.hpp"
#include "rays/image/core_image.hpp"
#include "rays/scene/scene.hpp"
#include "rays/world/int_scene.hpp"

namespace hitpipe::ref {

/// The image is of core_image() or checked_image(). The scene has no hierarchy, because the image is one. Camera
/// and lights are those of a mesh file, with the eye moved into the image's cube, unless the options say others.
/// The cube is as one that somebody chose. Throws std::runtime_error, one line, for an image without a triangle or
/// that lacks more than 2^26 of its mesh, and as place_in() does; std::invalid_argument for another n than the image's.
[[nodiscard]] IntScene image_scene(const CoreImage& image, const hls::WorldBits& bits, std::string name,
                                   const SceneOptions& options = {});

}  // namespace hitpipe::ref
