// The designs and formats that the tests emit: the thesis's, and the ends of the range.
#pragma once

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/pipeline.hpp"

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
  [[nodiscard]] Pipeline pipeline() const {
    return make_pipeline(found().trace(parsed()), Library::thesis());
  }
};
inline std::ostream& operator<<(std::ostream& out, const DesignFormat& d) {
  return out << d.design << ' ' << d.format;
}

/// Every design of the catalogue: integer designs at each of the formats, float designs at theirs.
inline std::vector<DesignFormat> every_design(const std::vector<std::string>& formats = {
                                                  "24/24", "20/24", "16/16", "12/12", "6/6", "6/11", "32/6",
                                                  "32/63"}) {
  std::vector<DesignFormat> all;
  for (const Design& design : designs()) {
    if (!design.conservative) all.push_back({std::string(design.name), to_string(design.default_format)});
    if (!design.conservative) continue;
    for (const std::string& format : formats) all.push_back({std::string(design.name), format});
  }
  return all;
}

/// "int_slabs_20_24".
inline std::string design_suffix(const testing::TestParamInfo<DesignFormat>& info) {
  std::string name = info.param.design + "_" + info.param.format;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

inline Pipeline int_slabs_pipeline(hls::IntBits bits) {
  return make_pipeline(find_design("int_slabs").trace(bits), Library::thesis());
}

}  // namespace hitpipe::rtl
