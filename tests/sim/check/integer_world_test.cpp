// The box units in formats of the integer world: no miss, at the smallest and the largest widths too.
#include <string>

#include <gtest/gtest.h>

#include "rays/tree/bvh.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/check/check.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim::integer_world_test {
namespace {

using Unit = std::tuple<std::string, std::string>;

class BoxUnits : public testing::TestWithParam<Unit> {};

TEST_P(BoxUnits, NeverMiss) {
  const auto& [name, bits] = GetParam();
  const rtl::Design& design = rtl::find_design(name);
  const Format format = design.parse_format(bits);
  CheckOptions options;
  options.tests = 60'000;
  const auto all = ref::adversary::categories();
  options.categories = {all.begin(), all.end()};
  CategoryResult sum;
  for (const CategoryResult& each : check([&] { return make_box_test(design, format); }, options))
    sum += each;
  EXPECT_EQ(sum.false_misses, 0U);
  EXPECT_GT(sum.hits, 15'000U);
  EXPECT_LT(sum.false_hits, (sum.tests - sum.hits) / 2);
}

INSTANTIATE_TEST_SUITE_P(Formats, BoxUnits,
                         testing::Combine(testing::Values("int_major", "int_major_pair"),
                                          testing::Values("6+0/4s8", "8+0/6f-1s8", "16+1/11s16", "20+1/11s20",
                                                          "24+3/13f3s32")));

TEST(IntegerWorld, DoesNotTraceAFloatScene) {
  const rtl::Design& design = rtl::find_design("int_major");
  const Software& software = software_of(design);
  EXPECT_THROW((void)software.feed(design.parse_format("20+1/11s20"), ref::Bvh{}), std::runtime_error);
}

}  // namespace
}  // namespace hitpipe::sim::integer_world_test
