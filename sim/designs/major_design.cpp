#include "sim/designs/major_design.hpp"

#include "sim/feeds/set_up_feed.hpp"

namespace hitpipe::sim {

namespace {

using hls::MajorBits;

/// n = 12, 14, .. 24, with an origin that is 0 to 2 bits finer and mantissas of 10, 12 and 14 bits.
std::vector<rtl::Format> major_sweep_formats() {
  std::vector<rtl::Format> formats;
  for (int n = 12; n <= 24; n += 2)
    for (int finer = 0; finer <= 2; ++finer)
      for (int mantissa = 10; mantissa <= 14; mantissa += 2) formats.push_back(MajorBits{n, finer, mantissa});
  return formats;
}

}  // namespace

std::int64_t* put_major_ray(const ref::IntMajorRay& ray, std::int64_t* out) {
  for (const int axis : {1, 2}) *out++ = ray.axes[0] == axis ? 1 : 0;
  for (const bool backward : ray.backward) *out++ = backward ? 1 : 0;
  out = put(ray.origin, out);
  for (const ref::MajorQuotient& each : ray.quotient) {
    *out++ = each.mantissa_low;
    *out++ = each.mantissa_high;
  }
  for (const ref::MajorQuotient& each : ray.quotient) *out++ = each.exponent;
  return out;
}

void major_boxes(std::span<const ref::Aabb> boxes, const rtl::Format& format, std::span<ref::IntBox> out) {
  const auto bits = format.as<MajorBits>();
  ref::quantise_boxes(boxes, bits.coord, out, bits.finer);
}

Software major_design_software() {
  return {.sweep_formats = major_sweep_formats(),
          .stiffness_formats = {MajorBits{20, 1, 12}, MajorBits{16, 1, 12}},
          .fit_from = MajorBits{20, 1, 12}};
}

}  // namespace hitpipe::sim
