#include "sim/sweep/plan.hpp"

#include <algorithm>
#include <map>

namespace hitpipe::sim {

std::vector<hls::IntBits> sweep_formats() {
  std::vector<hls::IntBits> formats;
  for (int n = 8; n <= hls::IntBits::max_coord; n += 4) {
    for (int t = n; t <= n + 8; t += 4) formats.push_back({n, std::min(t, hls::IntBits{n, t}.product())});
  }
  return formats;
}

std::vector<SweepPoint> plan_sweep(std::span<const rtl::Design* const> designs,
                                   std::span<const hls::IntBits> formats,
                                   std::span<const int> rays_in_flight) {
  std::map<RowKey, SweepPoint> points;
  for (const rtl::Design* const design : designs) {
    std::vector<rtl::Format> own(formats.begin(), formats.end());
    if (design->is_float()) own = {design->default_format()};
    for (const rtl::Format format : own) {
      static_cast<void>(design->evaluate(format));  // throws when there is none
      for (const int rays : rays_in_flight) {
        const SweepPoint point{design, format, rays};
        points.emplace(key_of(point), point);
      }
    }
  }
  std::vector<SweepPoint> sorted;
  for (const auto& [key, point] : points) sorted.push_back(point);
  return sorted;
}

RowKey key_of(const SweepPoint& point) {
  const auto all = rtl::designs();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const rtl::Design& d) { return d.name == point.design->name; });
  const auto place = static_cast<std::size_t>(found - all.begin());
  if (point.format.is_float()) return {place, 0, 0, point.rays_in_flight};
  const hls::IntBits bits = point.format.bits();
  return {place, bits.coord, bits.interval, point.rays_in_flight};
}

RowKey key_of(const std::string& design, const std::string& bits, int rays_in_flight) {
  const rtl::Design& found = rtl::find_design(design);
  return key_of({&found, found.parse_format(bits), rays_in_flight});
}

}  // namespace hitpipe::sim
