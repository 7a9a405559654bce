// The plan of a sweep: its formats and its order.
#include "sim/sweep/plan.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/sweep/sample_rows.hpp"

namespace hitpipe::sim::plan_test {
namespace {

TEST(SweepFormats, HoldThoseOfTheThesis) {
  const std::vector<Format> formats = sweep_formats(rtl::find_design("int_slabs"));
  for (const int n : {16, 20, 24}) {
    for (const int t : {n, n + 4, n + 8}) EXPECT_THAT(formats, testing::Contains(Format(hls::IntBits{n, t})));
  }
  std::map<int, int> of_n;
  for (const Format& format : formats) {
    EXPECT_TRUE(format.valid()) << to_string(format);
    ++of_n[format.as<hls::IntBits>().coord];
  }
  EXPECT_EQ(of_n, (std::map<int, int>{{8, 3}, {12, 3}, {16, 3}, {20, 3}, {24, 3}, {28, 3}, {32, 3}}));
}

std::string text_of(const std::vector<SweepPoint>& points) {
  std::string text;
  for (const SweepPoint& p : points)
    text += fmt::format("{} {} {}\n", p.design->name, to_string(p.format), p.rays_in_flight);
  return text;
}

TEST(SweepPlan, IsSortedAndHasEachRowOnce) {
  EXPECT_EQ(text_of(small_plan()),
            "fp_slabs fp32 1\nfp_slabs fp32 8\n"
            "int_slabs 6/6 1\nint_slabs 6/6 8\nint_slabs 24/24 1\nint_slabs 24/24 8\n"
            "int_plucker 6/6 1\nint_plucker 6/6 8\nint_plucker 24/24 1\nint_plucker 24/24 8\n");
}

TEST(SweepPlan, HasEachIntervalBehindItsRaysInFlight) {
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_slabs"), {hls::IntBits{6, 6}}}};
  const std::vector<SweepPoint> points =
      plan_sweep(designs, std::vector<int>{8, 1}, std::vector<int>{3, 1, 3});
  std::string text;
  for (const SweepPoint& p : points) text += fmt::format("{} {}, ", p.rays_in_flight, p.interval);
  EXPECT_EQ(text, "1 1, 1 3, 8 1, 8 3, ");
  EXPECT_LT(key_of(points[0]), key_of(points[1]));
  EXPECT_EQ(key_of(points[3]), key_of("int_slabs", "6/6", 8, 3));
}

TEST(SweepPlan, FindsThePlaceOfADesignByItsName) {
  const rtl::Design copied = rtl::find_design("int_slabs");
  EXPECT_EQ(key_of({&copied, hls::IntBits{6, 6}, 8}), key_of("int_slabs", "6/6", 8));
  rtl::Design outside = copied;
  outside.name = "outside";
  EXPECT_THROW((void)key_of({&outside, hls::IntBits{6, 6}, 8}), std::bad_optional_access);
}

}  // namespace
}  // namespace hitpipe::sim::plan_test
