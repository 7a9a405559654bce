// The designs and formats that the tests emit: the thesis's, and the ends of the range.
#pragma once

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/box/major_format.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/ray_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

inline auto tested_formats() {
  return testing::Values("24/24", "20/24", "16/16", "12/12", "6/6", "6/11", "32/6", "32/63");
}

/// The end of a test's name, for example "20_24".
inline std::string format_suffix(const testing::TestParamInfo<const char*>& format) {
  std::string name = format.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

struct DesignFormat {
  std::string design;
  std::string format;

  [[nodiscard]] const Design& found() const { return find_design(design); }
  [[nodiscard]] Format parsed() const { return found().parse_format(format); }
  /// The name of the unit's module and of its files.
  [[nodiscard]] std::string module() const { return found().module_at(parsed()); }
  [[nodiscard]] Pipeline pipeline() const {
    return make_pipeline(found().trace(parsed()), Library::thesis());
  }
  [[nodiscard]] Unit unit(const UnitOptions& options = {}) const {
    return make_unit(found(), parsed(), Library::thesis(), options);
  }
  [[nodiscard]] EmittedDesign emitted(const EmitOptions& options = {},
                                      const UnitOptions& of_unit = {}) const {
    return emit(unit(of_unit), options);
  }
  /// Of the whole unit.
  [[nodiscard]] ModuleInterface interface(FlowControl flow = FlowControl::stall) const {
    return unit_interface(module(), found().ports(parsed()), result_ports(found().results(parsed())), flow);
  }
};
inline std::ostream& operator<<(std::ostream& out, const DesignFormat& d) {
  return out << d.design << ' ' << d.format;
}

/// Every design of the catalogue, each at the formats of its family: n/t, n+g/p, floats, and in the integer
/// world rays and triangles. Without a format of its family a design has its default one. The default one of
/// int_ray takes tools ten times as long as any other; cores have it.
inline std::vector<DesignFormat> every_design(const std::vector<std::string>& integers,
                                              const std::vector<std::string>& major = {"20+1/13"},
                                              const std::vector<std::string>& any_float = {"e8m23"},
                                              const std::vector<std::string>& rays = {"8+0/4s8"},
                                              const std::vector<std::string>& triangles = {}) {
  std::vector<DesignFormat> all;
  for (const Design& design : designs()) {
    const Format& usual = design.default_format;
    const std::vector<std::string> one{to_string(usual)};
    const std::vector<std::string>& own = usual.is<hls::IntBits>()     ? integers
                                          : usual.is<hls::MajorBits>() ? major
                                          : usual.is<hls::FpBits>()    ? any_float
                                          : usual.is<hls::RayBits>()   ? rays
                                          : usual.is<hls::WorldBits>() ? triangles
                                                                       : one;
    for (const std::string& format : own.empty() ? one : own)
      all.push_back({std::string(design.name), format});
  }
  return all;
}
inline std::vector<DesignFormat> every_design() {
  return every_design({"24/24", "20/24", "16/16", "12/12", "6/6", "6/11", "32/6", "32/63"},
                      {"20+1/13", "16+0/8", "6+0/4", "12+2/10f1", "8+3/6f-1", "32+3/28"});
}

/// Each design once, at few bits: for tests that start a tool for each, of what does not depend on widths. The
/// triangle test is there with other results too.
inline std::vector<DesignFormat> every_small_design() {
  return every_design({"6/6"}, {"6+0/4"}, {"e5m10"}, {"8+0/4s8"}, {"8+0s8", "8+0s8c1", "8+0s8b1c2"});
}

/// For its testbench in Icarus, which takes a second for a thousand vectors of a large unit.
inline constexpr int few = 250;
inline VectorSet few_vectors(const DesignFormat& d) {
  constexpr std::uint64_t seed = 11;
  return {seed,
          {{"drawn", with_results(operand_vectors(d.found().ports(d.parsed()), few, seed),
                                  d.found().evaluate(d.parsed()))}}};
}
inline const std::string few_passed = fmt::format("PASS {} vectors", few);

/// "int_slabs_20_24", "int_major_8_3_6fm1".
inline std::string design_suffix(const testing::TestParamInfo<DesignFormat>& info) {
  std::string name = info.param.design + "_" + info.param.format;
  for (char& letter : name) {
    if (letter == '/' || letter == '+') letter = '_';
    if (letter == '-') letter = 'm';
  }
  return name;
}

/// The bits of results as their ports have them: of a graph's outputs, or of a design's own C++.
template <class Words>
std::vector<std::uint64_t> patterns_of(const Words& words, const std::vector<hls::Result>& results) {
  std::vector<std::uint64_t> patterns;
  for (std::size_t i = 0; i < results.size(); ++i)
    patterns.push_back(static_cast<std::uint64_t>(words[i]) & hls::low_mask(results[i].width));
  return patterns;
}

inline Pipeline int_slabs_pipeline(hls::IntBits bits) {
  return make_pipeline(find_design("int_slabs").trace(bits), Library::thesis());
}

}  // namespace hitpipe::rtl
