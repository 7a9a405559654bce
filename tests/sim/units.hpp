// The units that the tests of sim/ run: the designs, integer ones in the thesis's formats, in a narrow one
// and in the widest, and those with a major axis in their own format and in a narrow one. Each is built once,
// and loaded once by a program.
#pragma once

#include <array>
#include <map>
#include <ostream>
#include <string>

#include "rtl_gen/catalogue/major_formats.hpp"
#include "sim/verilated_design.hpp"

namespace hitpipe::sim {

struct Unit {
  const char* name;
  rtl::Format format;

  [[nodiscard]] const rtl::Design& design() const { return rtl::find_design(name); }
  [[nodiscard]] std::vector<rtl::Port> ports() const { return design().ports(format); }
  [[nodiscard]] rtl::Evaluate evaluate() const { return design().evaluate(format); }
  /// One of the six rows of Table 7.2.
  [[nodiscard]] bool of_the_thesis() const {
    return format.is<hls::FpBits>() || format == rtl::Format(hls::IntBits{24, 24}) ||
           format == rtl::Format(hls::IntBits{20, 24});
  }
};

inline const std::array units{
    Unit{"fp_slabs", rtl::Format(hls::FpBits{})}, Unit{"fp_plucker", rtl::Format(hls::FpBits{})},
    Unit{"int_slabs", hls::IntBits{24, 24}},      Unit{"int_slabs", hls::IntBits{20, 24}},
    Unit{"int_slabs", hls::IntBits{16, 16}},      Unit{"int_slabs", hls::IntBits{12, 12}},
    Unit{"int_slabs", hls::IntBits{6, 6}},        Unit{"int_slabs", hls::IntBits{32, 63}},
    Unit{"int_plucker", hls::IntBits{24, 24}},    Unit{"int_plucker", hls::IntBits{20, 24}},
    Unit{"int_plucker", hls::IntBits{6, 6}},      Unit{"int_plucker", hls::IntBits{32, 63}},
    Unit{"int_major", hls::MajorBits{}},          Unit{"int_major", hls::MajorBits{8, 3, 6, -1}}};

/// The name of a test, for example "int_slabs_24_24" or "int_major_8_3_6fm1".
inline std::string test_name(const Unit& unit) {
  std::string format = rtl::to_string(unit.format);
  for (char& letter : format) {
    if (letter == '/' || letter == '+') letter = '_';
    if (letter == '-') letter = 'm';
  }
  return std::string(unit.name) + "_" + format;
}

/// Prints a unit for GoogleTest.
inline void PrintTo(const Unit& unit, std::ostream* out) {
  *out << test_name(unit);
}

inline const VerilatedDesign& verilated(const Unit& unit) {
  static std::map<std::string, VerilatedDesign> known;
  return known.try_emplace(test_name(unit), unit.design(), unit.format, rtl::Library::thesis()).first->second;
}

}  // namespace hitpipe::sim
