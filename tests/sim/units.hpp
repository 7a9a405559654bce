// The units that the tests of sim/ run: every design, integer ones in the thesis's formats, a narrow one and
// the widest. Each is built once, and loaded once a program.
#pragma once

#include <array>
#include <map>
#include <ostream>
#include <string>

#include "sim/verilated_design.hpp"

namespace hitpipe::sim {

struct Unit {
  const char* name;
  rtl::Format format;

  [[nodiscard]] const rtl::Design& design() const { return rtl::find_design(name); }
  [[nodiscard]] std::vector<rtl::Port> ports() const { return rtl::input_ports(design().trace(format)); }
  [[nodiscard]] rtl::Evaluate evaluate() const { return design().evaluate(format); }
  /// One of the six rows of Table 7.2.
  [[nodiscard]] bool of_the_thesis() const {
    return format.is_float() || format == rtl::Format(24, 24) || format == rtl::Format(20, 24);
  }
};

inline const std::array units{Unit{"fp_slabs", rtl::Format::fp32()},
                              Unit{"fp_plucker", rtl::Format::fp32()},
                              Unit{"int_slabs", {24, 24}},
                              Unit{"int_slabs", {20, 24}},
                              Unit{"int_slabs", {16, 16}},
                              Unit{"int_slabs", {12, 12}},
                              Unit{"int_slabs", {6, 6}},
                              Unit{"int_slabs", {32, 63}},
                              Unit{"int_plucker", {24, 24}},
                              Unit{"int_plucker", {20, 24}},
                              Unit{"int_plucker", {6, 6}},
                              Unit{"int_plucker", {32, 63}}};

/// "int_slabs_24_24", for a test's name.
inline std::string test_name(const Unit& unit) {
  const std::string format = unit.format.is_float() ? "fp32"
                                                    : std::to_string(unit.format.bits().coord) + "_" +
                                                          std::to_string(unit.format.bits().interval);
  return std::string(unit.name) + "_" + format;
}

/// How GoogleTest prints a unit.
inline void PrintTo(const Unit& unit, std::ostream* out) {
  *out << test_name(unit);
}

inline const VerilatedDesign& verilated(const Unit& unit) {
  static std::map<std::string, VerilatedDesign> known;
  return known.try_emplace(test_name(unit), unit.design(), unit.format, rtl::Library::thesis()).first->second;
}

}  // namespace hitpipe::sim
