// The units that the tests of sim/ run: every registered design in its own format and, where its family has
// more, in a narrow one, in a wide one and in all that other tests use. Each is built once, and loaded once
// by a program.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/box/major_format.hpp"
#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

struct TestedUnit {
  std::string_view name;
  Format format;

  [[nodiscard]] const rtl::Design& design() const { return rtl::find_design(name); }
  [[nodiscard]] std::vector<rtl::Port> ports() const { return design().ports(format); }
  [[nodiscard]] rtl::Evaluate evaluate() const { return design().evaluate(format); }
  /// Nothing when its numbers are no floats.
  [[nodiscard]] std::optional<hls::FpBits> float_bits() const {
    if (format.is<hls::Binary32>()) return format.as<hls::Binary32>();
    if (format.is<hls::FpBits>()) return format.as<hls::FpBits>();
    return std::nullopt;
  }
  /// One of the six rows of Table 7.2.
  [[nodiscard]] bool of_the_thesis() const {
    const auto& rows = design().printed.rows;
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.format == format; });
  }
};

inline std::vector<TestedUnit> units() {
  const Format others[] = {hls::IntBits{24, 24}, hls::IntBits{16, 16}, hls::IntBits{12, 12},
                           hls::IntBits{6, 6},   hls::IntBits{32, 63}, hls::MajorBits{8, 3, 6, -1},
                           hls::FpBits{5, 10},   hls::FpBits{3, 2}};
  std::vector<TestedUnit> all;
  for (const rtl::Design& design : rtl::designs()) {
    const Format& own = design.default_format;
    all.push_back({design.name, own});
    for (const Format& other : others)
      if (&other.family() == &own.family() && other != own) all.push_back({design.name, other});
  }
  return all;
}

/// Those that test boxes.
inline std::vector<TestedUnit> units_of_boxes() {
  std::vector<TestedUnit> all = units();
  std::erase_if(all, [](const TestedUnit& unit) { return !unit.design().kind.of_boxes; });
  return all;
}

/// Those whose tests are of one box each.
inline std::vector<TestedUnit> units_of_one_box() {
  std::vector<TestedUnit> all = units_of_boxes();
  std::erase_if(all, [](const TestedUnit& unit) { return unit.design().kind.objects > 1; });
  return all;
}

/// The name of a test, for example "int_slabs_24_24" or "int_major_8_3_6fm1".
inline std::string test_name(const TestedUnit& unit) {
  std::string format = to_string(unit.format);
  for (char& letter : format) {
    if (letter == '/' || letter == '+') letter = '_';
    if (letter == '-') letter = 'm';
  }
  return std::string(unit.name) + "_" + format;
}

/// Prints a unit for GoogleTest.
inline void PrintTo(const TestedUnit& unit, std::ostream* out) {
  *out << test_name(unit);
}

/// With `good` in its Verilog replaced by `bad`.
inline rtl::Unit damaged(rtl::Unit unit, const std::string& good, const std::string& bad) {
  const std::size_t at = unit.verilog.find(good);
  EXPECT_NE(at, std::string::npos) << good;
  if (at != std::string::npos) unit.verilog.replace(at, good.size(), bad);
  return unit;
}

inline const VerilatedDesign& verilated(const TestedUnit& unit) {
  static std::map<std::string, VerilatedDesign> known;
  const std::string name = test_name(unit);
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  return known.try_emplace(name, rtl::make_unit(unit.design(), unit.format, rtl::Library::thesis()))
      .first->second;
}

}  // namespace hitpipe::sim
