// Which rows a sweep has: designs, number formats and rays in flight, in the order of the file.
#pragma once

#include <compare>
#include <span>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

struct SweepPoint {
  const rtl::Design* design;
  rtl::Format format;
  int rays_in_flight;
};

/// n = 8, 12, .. 32, each with t = n, n + 4, n + 8, cut to the product's 2n - 1 bits. All formats of Tables
/// 6.2 to 6.7 are among them.
[[nodiscard]] std::vector<hls::IntBits> sweep_formats();

/// Every design with each of its formats and each number of rays in flight, once. Of float designs `formats`
/// says nothing. Throws std::runtime_error, one line, for a format that a design does not have.
[[nodiscard]] std::vector<SweepPoint> plan_sweep(std::span<const rtl::Design* const> designs,
                                                 std::span<const hls::IntBits> formats,
                                                 std::span<const int> rays_in_flight);

/// Where a row stands in the file: by the design's place in the catalogue, bits, rays in flight. A design
/// that is not in the catalogue comes last.
struct RowKey {
  std::size_t design;
  int coord;
  int interval;
  int rays_in_flight;

  friend auto operator<=>(const RowKey&, const RowKey&) = default;
};

[[nodiscard]] RowKey key_of(const SweepPoint& point);
/// Of a row's cells. Throws as rtl::find_design() and rtl::Design::parse_format() do.
[[nodiscard]] RowKey key_of(const std::string& design, const std::string& bits, int rays_in_flight);

}  // namespace hitpipe::sim
