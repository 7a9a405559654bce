// The operands of hls::BlockSlabsOperands. Rays are as in int_slabs, and boxes are rounded outward once
// more.
#include "hls/box/block_slabs_operands.hpp"
#include "hls/box/int_format.hpp"
#include "rays/world/int_box.hpp"
#include "sim/designs/port_ranges.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"

namespace hitpipe::sim {

namespace {

using hls::BlockBits;

hls::IntBits block_grid(const Format& format) {
  const int n = format.as<BlockBits>().coord;
  return {n, n};
}

/// Mantissas and, in `others`, their exponent.
struct BlockBox : ref::IntBox {
  std::array<std::int64_t, 1> others{};
};

/// The least exponent with which all planes have mantissas of M bits.
BlockBox block_box(const ref::IntBox& box, BlockBits bits) {
  const auto fits = [&](std::int32_t mantissa) {
    return mantissa >= -bits.largest_mantissa() - 1 && mantissa <= bits.largest_mantissa();
  };
  BlockBox block;
  for (int exponent = 0;; ++exponent) {
    bool all_fit = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.min[axis] = box.min[axis] >> exponent;
      block.max[axis] = -(-box.max[axis] >> exponent);
      all_fit = all_fit && fits(block.min[axis]) && fits(block.max[axis]);
    }
    block.others[0] = exponent;
    if (all_fit) return block;
  }
}

class BlockSetup {
 public:
  using Box = BlockBox;
  using Bits = BlockBits;
  using Operands = hls::BlockSlabsOperands<Words, Bits>;

  BlockSetup(const ref::Ray& ray, const Format& format)
      : ray_(ref::IntSlabsRaySetup(ray, block_grid(format)).ray()) {}

  static void boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<Box> out) {
    std::vector<ref::IntBox> on_grid(boxes.size());
    ref::quantise_boxes(boxes, block_grid(format).coord, on_grid);
    for (std::size_t i = 0; i < boxes.size(); ++i) out[i] = block_box(on_grid[i], format.as<BlockBits>());
  }
  void fill(float /*length*/, Operands& in) const {
    put(ray_.origin, in.rx, in.ry, in.rz);
    put(ray_.irdvc_floor, in.inv_x, in.inv_y, in.inv_z);
  }

 private:
  ref::IntSlabsRay ray_;
};

/// A scene tells nothing of a mantissa: the largest plane decides the exponent.
std::optional<SceneDemand> block_demand(const rtl::Port& port, const Format& format,
                                        const ref::SceneDemands& scene, const ref::CoarseAxes& /*none*/) {
  const int n = block_grid(format).coord;
  const int axis = rtl::axis_of(port);
  if (port.role == hls::Role::origin) {
    if (const Range range = int_origin(scene, axis, n)) return SceneDemand{{*range}, 1};
  }
  if (port.role == hls::Role::inverse_low) {
    if (const auto ranges = int_irdvc(scene, axis, n)) return SceneDemand{{ranges->floor}};
  }
  return std::nullopt;
}

}  // namespace

Software block_slabs_software() {
  return {.feed = set_up_feed<BlockSetup>, .box_test = set_up_test<BlockSetup>, .demand = block_demand};
}

}  // namespace hitpipe::sim
