#include "sim/core/core_set.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sim/core/native_core.hpp"
#include "sim/machine/verilated_machine.hpp"

namespace hitpipe::sim {

namespace {

void check_room(const ref::CoreHeader& image, const rtl::CoreOptions& core) {
  const auto check = [](const char* option, int given, const std::string& has, int needed, int most) {
    if (needed > given)
      throw std::runtime_error(
          fmt::format("{} {}: the scene has {}; allowed is {} to {}", option, given, has, needed, most));
  };
  check("--levels", core.levels, fmt::format("{} records on a path", image.levels), image.levels,
        rtl::CoreOptions::most_levels);
  check("--number-bits", core.number_bits, fmt::format("{} triangles", image.in_source()),
        image.number_bits(), hls::triangle_number_bits);
  check("--leaf-bits", core.leaf_bits, fmt::format("leaves with {} triangles", image.most_in_leaf),
        image.leaf_bits(), hls::child_count_bits);
}

}  // namespace

CoreSet::CoreSet(std::shared_ptr<const ref::IntScene> scene, const ref::CoreImage& image,
                 CoreSetOptions options)
    : scene_(std::move(scene)),
      image_(image),
      options_(std::move(options)),
      walking_{.world = options_.bits.world(),
               .boxes = options_.bits.boxes(),
               .places = 1 << options_.core.stack_bits} {
  check_room(image.header, options_.core);
}

void CoreSet::make(const rtl::Library& library) {
  std::vector<rtl::CoreOptions> each;
  for (const int rays : options_.rays_in_flight) {
    rtl::CoreOptions& core = each.emplace_back(options_.core);
    core.bits = options_.bits;
    core.rays = rays;
    make_room(core, image_);
  }
  cores_ = rtl::make_cores(each, library);
  for (const rtl::Core& core : cores_) {
    if (options_.native)
      machines_.push_back(std::make_unique<NativeCore>(core));
    else
      machines_.push_back(std::make_unique<VerilatedMachine>(core, rtl::to_verilog(core, library)));
  }
}

}  // namespace hitpipe::sim
