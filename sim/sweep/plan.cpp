#include "sim/sweep/plan.hpp"

#include <map>

#include "sim/software/software.hpp"

namespace hitpipe::sim {

std::vector<Format> sweep_formats(const rtl::Design& design) {
  const std::vector<Format>& own = software_of(design).sweep_formats;
  return own.empty() ? std::vector<Format>{design.default_format} : own;
}

std::vector<SweepPoint> plan_sweep(std::span<const DesignFormats> designs,
                                   std::span<const int> rays_in_flight, std::span<const int> intervals) {
  std::map<RowKey, SweepPoint> points;
  for (const DesignFormats& each : designs) {
    for (const Format& format : each.formats) {
      static_cast<void>(each.design->evaluate(format));  // throws if the design has no such format
      for (const int rays : rays_in_flight) {
        for (const int interval : intervals) {
          const SweepPoint point{each.design, format, rays, interval};
          points.emplace(key_of(point), point);
        }
      }
    }
  }
  std::vector<SweepPoint> sorted;
  for (const auto& [key, point] : points) sorted.push_back(point);
  return sorted;
}

RowKey key_of(const SweepPoint& point) {
  return {rtl::place_of(*point.design).value(), point.format.numbers(), point.rays_in_flight, point.interval};
}

RowKey key_of(const std::string& design, const std::string& bits, int rays_in_flight, int interval) {
  const rtl::Design& found = rtl::find_design(design);
  return key_of({&found, found.parse_format(bits), rays_in_flight, interval});
}

}  // namespace hitpipe::sim
