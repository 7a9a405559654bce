// Cores of small formats, and the rays of pictures of a small scene for them.
#pragma once

#include <memory>

#include "rays/image/core_image.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/core/picture_rays.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::core_pictures {

inline constexpr hls::WorldBits world{12, 1, 12, 0, 0};
inline constexpr hls::MajorBits boxes{12, 1, 7, 0, 12};
inline constexpr hls::RayBits bits{12, 1, 7, 0, 12, 0};

struct CorePicture {
  std::shared_ptr<const ref::IntScene> scene;
  ref::CoreImage image;
  PictureRays rays;

  explicit CorePicture(int places, int size = 48, const hls::WorldBits& of = world,
                       const hls::MajorBits& with = boxes)
      : scene(std::make_shared<const ref::IntScene>(
            ref::int_scene(hills(), of, {.build = {.builder = ref::Builder::sah, .max_triangles = 2}}))),
        image(ref::core_image(*scene)),
        rays(picture_rays(scene, image, {of, with, places}, {.width = size, .height = size})) {}
};

inline rtl::CoreOptions options_of(int rays, int stack_bits, int address_bits = 24) {
  return {
      .bits = bits, .rays = rays, .stack_bits = stack_bits, .address_bits = address_bits, .byte_bits = 40};
}
inline const rtl::Library& library() {
  static const rtl::Library own = rtl::library_called(rtl::default_library);
  return own;
}

}  // namespace hitpipe::sim::core_pictures
