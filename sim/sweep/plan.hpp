// The rows of a sweep: designs, number formats, rays in flight and initiation intervals, in the order of the
// file.
#pragma once

#include <array>
#include <compare>
#include <span>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

struct SweepPoint {
  const rtl::Design* design;
  Format format;
  int rays_in_flight;
  int interval = 1;  ///< a test may begin every so many cycles
};

/// A design and the formats that are asked for.
struct DesignFormats {
  const rtl::Design* design;
  std::vector<Format> formats;
};
/// The formats in which a design is swept without --bits. The default format if the design states none.
[[nodiscard]] std::vector<Format> sweep_formats(const rtl::Design& design);

inline constexpr std::array every_cycle{1};

/// Every design in each of its formats with each number of rays in flight at each interval, each combination
/// once. Throws std::runtime_error, one line, for a format that a design does not have.
[[nodiscard]] std::vector<SweepPoint> plan_sweep(std::span<const DesignFormats> designs,
                                                 std::span<const int> rays_in_flight,
                                                 std::span<const int> intervals = every_cycle);

/// The place of a row in the file: place of the design in the catalogue, format, rays in flight, interval.
struct RowKey {
  std::size_t design;
  FormatNumbers format;
  int rays_in_flight;
  int interval;

  friend auto operator<=>(const RowKey&, const RowKey&) = default;
};

[[nodiscard]] RowKey key_of(const SweepPoint& point);
/// The key of a row by its cells. Throws what rtl::find_design() and rtl::Design::parse_format() throw.
[[nodiscard]] RowKey key_of(const std::string& design, const std::string& bits, int rays_in_flight,
                            int interval = 1);

}  // namespace hitpipe::sim
