// The operands of hls::FpSlabsSafeOperands (docs/operands.md).
#include "sw_ref/trace/fp_slabs_safe.hpp"

#include <algorithm>
#include <cmath>

#include "hls/box/fp_format.hpp"
#include "hls/box/fp_slabs_safe_operands.hpp"
#include "sim/designs/port_ranges.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/hierarchy/fp_nodes.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"
#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::sim {

namespace {

using hls::FpBits;

class FpSlabsSafeSetup {
 public:
  struct Box {
    std::array<std::int64_t, 3> min{}, max{};
  };
  using Bits = FpBits;
  using Operands = hls::FpSlabsSafeOperands<Words, Bits>;

  FpSlabsSafeSetup(const ref::Ray& ray, const Format& format)
      : bits_(format.as<FpBits>()), set_up_(ray, bits_) {
    for (std::size_t i = 0; i < 3; ++i) {
      origin_low_[i] = ref::fp_pattern(set_up_.ray().origin_low[i], bits_);
      origin_high_[i] = ref::fp_pattern(set_up_.ray().origin_high[i], bits_);
    }
  }

  static void boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<Box> out) {
    const auto bits = format.as<FpBits>();
    const ref::FpRounding rounding(bits);
    std::transform(boxes.begin(), boxes.end(), out.begin(), [&](const ref::Aabb& box) {
      const ref::Aabb rounded = rounding.outward(box);
      Box patterns;
      for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        patterns.min[i] = ref::fp_pattern(rounded.min[axis], bits);
        patterns.max[i] = ref::fp_pattern(rounded.max[axis], bits);
      }
      return patterns;
    });
  }
  void fill(float length, Operands& in) const {
    const ref::FpSlabsSafeRay& ray = set_up_.ray();
    const ref::FpSlabsSafeEnd end = set_up_.end(length);
    put(ray.back, in.back_x, in.back_y, in.back_z);
    put(origin_low_, in.rx, in.ry, in.rz);
    put(origin_high_, in.rx_up, in.ry_up, in.rz_up);
    in.rlen = end.length;
    put(ray.inverse_low, in.ri_low, in.rj_low, in.rk_low);
    put(ray.inverse_high, in.ri_high, in.rj_high, in.rk_high);
    in.rinf = end.endless ? 1 : 0;
  }

 private:
  FpBits bits_;
  ref::FpSlabsSafeRaySetup set_up_;
  std::array<std::int64_t, 3> origin_low_{}, origin_high_{};
};

std::unique_ptr<ref::Tracer> fp_slabs_safe_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                                  const ref::Bvh& bvh) {
  const auto bits = unit.format.as<FpBits>();
  return ref::store_tracer(ref::FpNodes(bvh, bits), ref::FpSlabsSafeTestMaker(bits), ref::Leaves(mesh, bvh),
                           {.ends = unit.ends});
}

std::vector<Format> fp_slabs_safe_sweep_formats() {
  return {FpBits{5, 7},  FpBits{5, 10}, FpBits{8, 7},  FpBits{6, 13},
          FpBits{8, 11}, FpBits{8, 15}, FpBits{8, 19}, FpBits{8, 23}};
}

/// Groups by M; in each group sorted by E.
std::vector<std::vector<Format>> fp_slabs_safe_smaller_formats(const Format& most) {
  const auto bits = most.as<FpBits>();
  std::vector<std::vector<Format>> groups;
  for (int m = std::min(4, bits.fraction); m <= bits.fraction; ++m) {
    std::vector<Format>& group = groups.emplace_back();
    for (int e = std::min(3, bits.exponent); e <= bits.exponent; ++e) group.push_back(FpBits{e, m});
  }
  return groups;
}

std::optional<SceneDemand> fp_slabs_safe_demand(const rtl::Port& port, const Format& format,
                                                const ref::SceneDemands& scene,
                                                const ref::CoarseAxes& /*none*/) {
  const auto bits = format.as<FpBits>();
  const int axis = rtl::axis_of(port);
  switch (port.role) {
    case hls::Role::backward:
      return SceneDemand{{backward(scene, axis)}};
    case hls::Role::origin:
    case hls::Role::origin_high:
      return SceneDemand{mirrored_origin(scene, axis, bits, port.role == hls::Role::origin)};
    case hls::Role::plane_low:
    case hls::Role::plane_high:
      return SceneDemand{rounded_planes(scene, axis, bits, port.role == hls::Role::plane_low)};
    case hls::Role::inverse_low:
    case hls::Role::inverse_high:
      return SceneDemand{{scaled_inverse(scene, axis, bits, port.role == hls::Role::inverse_low)}};
    default:
      return std::nullopt;
  }
}

/// A mantissa with its leading one, and the remainder that says whether it is exact.
area::Divisions fp_slabs_safe_divisions(const Format& format) {
  return {.count = 3, .quotient_bits = format.as<hls::FpBits>().fraction + 2};
}

}  // namespace

Software fp_slabs_safe_software() {
  const auto own = ref::adversary::float_unit_categories();
  return {.feed = set_up_feed<FpSlabsSafeSetup>,
          .box_test = set_up_test<FpSlabsSafeSetup>,
          .tracer = fp_slabs_safe_tracer,
          .divisions = fp_slabs_safe_divisions,
          .demand = fp_slabs_safe_demand,
          .smaller_formats = fp_slabs_safe_smaller_formats,
          .sweep_formats = fp_slabs_safe_sweep_formats(),
          .stiffness_formats = {FpBits{8, 23}, FpBits{8, 15}, FpBits{8, 7}, FpBits{5, 10}},
          .fit_from = FpBits(),
          .categories = {own.begin(), own.end()}};
}

}  // namespace hitpipe::sim
