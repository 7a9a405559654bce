// The formats that the tests emit: the thesis's, and the ends of the range.
#pragma once

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/pipeline.hpp"

namespace hitpipe::rtl {

inline auto tested_formats() {
  return testing::Values("24/24", "20/24", "16/16", "12/12", "6/6", "6/11", "32/6", "32/63");
}

/// "20_24" at the end of a test's name.
inline std::string format_suffix(const testing::TestParamInfo<const char*>& format) {
  std::string name = format.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

inline Pipeline int_slabs_pipeline(hls::IntBits bits) {
  return make_pipeline(find_design("int_slabs").trace(bits), Library::thesis());
}

}  // namespace hitpipe::rtl
