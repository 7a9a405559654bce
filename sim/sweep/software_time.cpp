#include "sim/sweep/software_time.hpp"

#include <algorithm>
#include <cmath>

#include "area_model/price.hpp"
#include "sw_ref/traverse/tracer.hpp"

namespace hitpipe::sim {

namespace {

std::vector<ref::RecordedBatch> record(const ref::Scene& scene, const ref::Bvh& bvh, int width, int height) {
  const int longest = std::max({width, height, SoftwareTime::longest_side});
  const auto scaled = [&](int side) { return std::max(1, side * SoftwareTime::longest_side / longest); };
  return ref::record_rays(scene, bvh, scaled(width), scaled(height), 1);
}

/// Near child first, as the unit's traversal.
ref::TracerOptions tracing(const rtl::Design& design, rtl::Format format) {
  const bool plucker = design.name.ends_with("plucker");
  ref::TracerOptions options;
  options.algorithm = plucker ? ref::Algorithm::plu_dsa : ref::Algorithm::slabs_dsa;
  options.arithmetic = design.is_float() ? ref::Arithmetic::binary32 : ref::Arithmetic::integer;
  if (!format.is_float()) options.bits = format.bits();
  return options;
}

}  // namespace

double milli(double time) {
  return std::round(1e3 * time) / 1e3;
}

SoftwareTime::SoftwareTime(const ref::Scene& scene, const ref::Bvh& bvh, int width, int height)
    : scene_(scene), bvh_(bvh), batches_(record(scene, bvh, width, height)) {}

double SoftwareTime::seconds(const rtl::Design& design, rtl::Format format) const {
  constexpr int runs = 3;
  const std::unique_ptr<ref::Tracer> tracer = ref::make_tracer(scene_.mesh, bvh_, tracing(design, format));
  return ref::measure(*tracer, batches_, runs).seconds;
}

double SoftwareTime::ratio(const rtl::Design& design, rtl::Format format) const {
  if (design.name == area::yardstick) return 1.0;
  const double yardstick = seconds(rtl::find_design(area::yardstick), rtl::Format::fp32());
  return yardstick > 0 ? milli(seconds(design, format) / yardstick) : 0.0;
}

}  // namespace hitpipe::sim
