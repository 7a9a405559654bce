// The check finds faults: each fault in a set-up or a datapath gives a false miss within 10^6 tests. Where
// the thesis's text itself fails, one ray and box of docs/never_misses.md shows it.
#include "tests/sim/check/mutations.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hls/box/major_format.hpp"
#include "rays/exact/box_referee.hpp"
#include "sim/check/check.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/judge/adversary/case.hpp"

namespace hitpipe::sim::mutations_test {
namespace {

using ref::adversary::Category;

constexpr std::uint64_t seed = 20076;
constexpr std::uint64_t most_tests = 1'000'000;

using Formats = std::vector<Format>;

/// The thesis's two.
const Formats& thesis() {
  static const Formats both{hls::IntBits{24, 24}, hls::IntBits{20, 24}};
  return both;
}
Formats integers(std::initializer_list<hls::IntBits> bits) {
  return {bits.begin(), bits.end()};
}
Formats major(std::initializer_list<hls::MajorBits> bits) {
  return {bits.begin(), bits.end()};
}

const Formats integer_world = major({{20, 1, 11, 0, 20}, {16, 1, 11, 0, 16}, {8, 0, 6, -1, 8}});
const Formats usual_major = major({{20, 1, 12}, {16, 0, 8}, {12, 2, 10, 1}, {8, 3, 6, -1}});

struct Mutation {
  const char* name;
  const char* design;
  SetupFault* set_up = nullptr;
  GraphFault* datapath = nullptr;
  Formats formats = thesis();
  std::string_view category = "";  ///< drawn alone; empty: all are drawn

  [[nodiscard]] std::unique_ptr<BoxTest> make(const Format& format) const {
    const rtl::Design& right = rtl::find_design(design);
    return set_up != nullptr ? mutated_set_up(right, format, set_up)
                             : mutated_datapath(right, format, datapath);
  }
};

void PrintTo(const Mutation& mutation, std::ostream* out) {
  *out << mutation.name;
}

/// Formats other than the thesis's two leave the fault no slack. The bounds of Pluecker are reached only with
/// the worst roundings of origin and direction. One category aims at these; at 24 bits, binary32 has too few
/// bits of its own to come that close.
const std::vector<Mutation> faults{
    {.name = "SlabsHalfUnitLeftOut", .design = "int_slabs", .set_up = half_unit_left_out},
    {.name = "SlabsBoxRoundedToNearest", .design = "int_slabs", .set_up = box_rounded_to_nearest},
    {.name = "SlabsOriginTruncated", .design = "int_slabs", .set_up = origin_truncated},
    {.name = "IrdvcInBinary32", .design = "int_slabs", .set_up = irdvc_in_binary32},
    {.name = "IrdvcInBinary32Clamped",
     .design = "int_slabs",
     .set_up = irdvc_in_binary32_clamped,
     .formats = integers({{32, 63}})},
    {.name = "IrdvcBelowOneIsZero",
     .design = "int_slabs",
     .set_up = irdvc_below_one_is_zero,
     .formats = integers({{20, 24}, {24, 32}})},
    {.name = "IrlenNotSaturated", .design = "int_slabs", .set_up = irlen_not_saturated},
    {.name = "IrlenTrimmedOneBitMore", .design = "int_slabs", .set_up = irlen_trimmed_one_bit_more},
    {.name = "IrlenFlooredBeforeTheGrid", .design = "int_slabs", .set_up = irlen_floored_before_the_grid},
    {.name = "NearFloorDropped", .design = "int_slabs", .datapath = near_floor_dropped},
    {.name = "NearOperandsSwapped", .design = "int_slabs", .datapath = near_operands_swapped},
    {.name = "FarFromTheNearPlane", .design = "int_slabs", .datapath = far_from_the_near_plane},
    {.name = "PlueckerHalfUnitLeftOut",
     .design = "int_plucker",
     .set_up = half_unit_left_out,
     .formats = integers({{20, 24}, {16, 16}, {12, 12}, {12, 23}}),
     .category = "one_grid_unit"},
    {.name = "PlueckerBoxRoundedToNearest",
     .design = "int_plucker",
     .set_up = box_rounded_to_nearest,
     .formats = integers({{20, 24}, {16, 16}, {12, 12}, {12, 23}}),
     .category = "one_grid_unit"},
    {.name = "EndpointClamped", .design = "int_plucker", .set_up = endpoint_clamped},
    {.name = "PlueckerRinfIgnored", .design = "int_plucker", .set_up = pluecker_rinf_ignored},
    {.name = "EdgeBoundOffByOne",
     .design = "int_plucker",
     .datapath = edge_bound_off_by_one,
     .formats = integers({{24, 24}, {16, 16}, {12, 12}})},
    {.name = "EdgeBoundOffByOneWithFifteenBitsDropped",
     .design = "int_plucker",
     .datapath = edge_bound_off_by_one,
     .formats = integers({{20, 24}}),
     .category = "one_grid_unit"},
    {.name = "SideBitDropped", .design = "int_plucker", .datapath = side_bit_dropped},
    {.name = "EdgePlanesSwapped", .design = "int_plucker", .datapath = edge_planes_swapped},
    {.name = "LastPlaneForTheFirst", .design = "int_plucker", .datapath = last_plane_for_the_first},
    {.name = "MajorBoxNotGrown",
     .design = "int_major",
     .set_up = major_box_not_grown,
     .formats = usual_major},
    {.name = "MajorBoxGrownByHalfAsMuch",
     .design = "int_major",
     .set_up = major_box_grown_by_half_as_much,
     .formats = usual_major},
    {.name = "MajorOriginTiesReversed",
     .design = "int_major",
     .set_up = major_origin_ties_reversed,
     .formats = usual_major},
    {.name = "MajorMantissaToNearest",
     .design = "int_major",
     .set_up = major_mantissa_to_nearest,
     .formats = usual_major},
    {.name = "MajorUpperMantissaOfTwoCut",
     .design = "int_major",
     .set_up = major_upper_mantissa_of_two_cut,
     .formats = major({{20, 1, 12}, {16, 0, 8}, {24, 1, 10}})},
    {.name = "MajorExponentCapOneLess",
     .design = "int_major",
     .set_up = major_exponent_cap_one_less,
     .formats = major({{20, 1, 12}, {16, 0, 8}, {12, 2, 6, 1}})},
    {.name = "MajorLengthWraps", .design = "int_major", .set_up = major_length_wraps, .formats = usual_major},
    {.name = "MajorShiftWraps", .design = "int_major", .datapath = major_shift_wraps, .formats = usual_major},
    {.name = "MajorNearRoundedUp",
     .design = "int_major",
     .datapath = major_near_rounded_up,
     .formats = major({{20, 1, 12}, {20, 1, 12, -2}, {16, 2, 14, 1}, {8, 3, 10, -1}})},
    {.name = "MajorNearWithTheUpperBound",
     .design = "int_major",
     .datapath = major_near_with_the_upper_bound,
     .formats = usual_major},
    {.name = "MajorFarWithTheLowerBound",
     .design = "int_major",
     .datapath = major_far_with_the_lower_bound,
     .formats = usual_major},
    {.name = "MajorMirroredPlaneFilledWithZeros",
     .design = "int_major",
     .datapath = major_mirrored_plane_filled_with_zeros,
     .formats = major({{20, 1, 12}, {12, 2, 10, 1}, {8, 3, 6, -1}})},
    {.name = "MajorFarCarryMissing",
     .design = "int_major",
     .datapath = major_far_carry_missing,
     .formats = integer_world},
    {.name = "MajorPairFarCarryMissing",
     .design = "int_major_pair",
     .datapath = major_far_carry_missing,
     .formats = integer_world},
};

/// Changes that are not faults; their comments prove it.
const std::vector<Mutation> no_faults{
    {.name = "SlabsDatapathMadeAgain", .design = "int_slabs", .datapath = made_again},
    {.name = "PlueckerDatapathMadeAgain", .design = "int_plucker", .datapath = made_again},
    {.name = "MajorDatapathMadeAgain",
     .design = "int_major",
     .datapath = made_again,
     .formats = major({{20, 1, 12}, {8, 3, 6, -1}})},
    {.name = "SlabsRinfIgnored", .design = "int_slabs", .set_up = slabs_rinf_ignored},
    {.name = "EndpointRoundedInward",
     .design = "int_plucker",
     .set_up = endpoint_rounded_inward,
     .formats = integers({{24, 24}, {12, 23}})},
    {.name = "DirectionTruncated",
     .design = "int_plucker",
     .set_up = direction_truncated,
     .formats = integers({{24, 24}, {12, 23}})},
};

struct Verdict {
  std::uint64_t tests = 0;
  std::uint64_t false_misses = 0;
  CategoryResult worst;  ///< the category with most misses
};

Verdict judge(const Mutation& mutation, const Format& format, std::uint64_t tests) {
  std::vector<Category> drawn;
  const auto draw = [&](std::span<const Category> from) {
    for (const Category& c : from) {
      if (mutation.category.empty() || mutation.category == c.name) drawn.push_back(c);
    }
  };
  draw(ref::adversary::categories());
  draw(software_of(rtl::find_design(mutation.design)).categories);
  Verdict verdict;
  for (const CategoryResult& r : check([&] { return mutation.make(format); },
                                       {.categories = std::move(drawn), .tests = tests, .seed = seed})) {
    verdict.tests += r.tests;
    verdict.false_misses += r.false_misses;
    if (r.false_misses > verdict.worst.false_misses) verdict.worst = r;
  }
  fmt::print("{}: {} false misses in {} tests of seed {}, most of them in {}\n", to_string(format),
             verdict.false_misses, verdict.tests, seed,
             verdict.false_misses == 0 ? "none" : verdict.worst.category);
  return verdict;
}

class Mutations : public testing::TestWithParam<Mutation> {};

/// Parts of the tests come first, because most faults show at once.
TEST_P(Mutations, GiveAFalseMissWithinAMillionTests) {
  for (const Format& format : GetParam().formats) {
    Verdict verdict;
    for (const std::uint64_t tests :
         {std::uint64_t{1}, most_tests / 50, most_tests / 5, most_tests * 19 / 20}) {
      verdict = judge(GetParam(), format, tests);
      if (verdict.false_misses > 0) break;
    }
    EXPECT_LE(verdict.tests, most_tests);
    ASSERT_GT(verdict.false_misses, 0U);
    ASSERT_TRUE(verdict.worst.false_miss);
    EXPECT_TRUE(is_false_miss(*GetParam().make(format), *verdict.worst.false_miss));
  }
}

class HarmlessChanges : public testing::TestWithParam<Mutation> {};

/// So the faults themselves cause what they show, and not the machinery that inserts them.
TEST_P(HarmlessChanges, GiveNoFalseMiss) {
  for (const Format& format : GetParam().formats) {
    const Verdict verdict = judge(GetParam(), format, most_tests / 5);
    EXPECT_EQ(verdict.false_misses, 0U);
    EXPECT_GE(verdict.tests, most_tests / 5);
  }
}

/// A step of the thesis's text, taken literally, and a ray and a box that the unit then misses.
struct AsWritten {
  Mutation step;
  hls::IntBits bits;
  const char* replay;
  std::string_view port = "";  ///< of a set-up: an operand that comes out wrong
  std::int64_t written = 0;
  std::int64_t right = 0;
};

void PrintTo(const AsWritten& example, std::ostream* out) {
  *out << example.step.name;
}

const std::vector<AsWritten> examples{
    {{.name = "IrdvcOnePastTheWidth", .design = "int_slabs", .set_up = irdvc_in_binary32},
     {24, 24},
     "origin 0 0 0 direction 1 1 0x1.6p-1 length inf box 0 0 0 to 0 0 0",
     "irk_ceil",
     8388608,
     8388607},
    {{.name = "IrdvcInBinary32", .design = "int_slabs", .set_up = irdvc_in_binary32_clamped},
     {32, 63},
     "origin 0x1.ap-1 1 -1 direction -0x1.ap+5 -1 0x1p+6 length inf box 0 0 0 to 0 1 0",
     "irk_floor",
     33554432,
     33554431},
    {{.name = "FloorAndCeilOfTheCLibrary", .design = "int_slabs", .set_up = irdvc_below_one_is_zero},
     {20, 24},
     "origin 1 -0x1.9fp-1 1 direction -0x1p+54 -0x1p+65 -0x1p+75 length inf box 0 -1 -1 to 1 -0x1.ap-1 0",
     "irk_floor",
     0,
     -1},
    {{.name = "LengthNotCut", .design = "int_slabs", .set_up = irlen_not_saturated},
     {16, 16},
     "origin 0 0 0 direction 1 1 1 length 4 box 0 0 0 to 0 0 0",
     "irlen",
     -6,
     32767},
    {{.name = "BoxInBinary32", .design = "int_slabs", .set_up = box_in_binary32},
     {32, 32},
     "origin 0x1.78p-1 1 -1 direction 0x1.057df8p-6 -0x1p-4 0x1p-4 length 0x1p+4 box 0x1.fabefcp-1 0 0 to 1 "
     "0 "
     "0",
     "ixmin",
     1062723456,
     1062723454},
    {{.name = "EndClampedByComponent", .design = "int_plucker", .set_up = endpoint_clamped},
     {16, 16},
     "origin 0 0 0 direction -0x1p+87 -1 0 length 1 box 0 0 0 to 0 0 0",
     "irey",
     -16383,
     0},
    {{.name = "SideRelationOfTBits", .design = "int_plucker", .datapath = side_bit_dropped},
     {24, 24},
     "origin 1 0 0 direction 1 0 1 length inf box -1 0 0 to 1 0 1"},
};

class TextAsWritten : public testing::TestWithParam<AsWritten> {};

TEST_P(TextAsWritten, MissesABoxThatTheRayMeets) {
  const AsWritten& example = GetParam();
  const ref::adversary::Case c = ref::adversary::parse_case(example.replay);
  EXPECT_TRUE(ref::ray_meets_box_exact(c.ray, c.box));
  const rtl::Design& design = rtl::find_design(example.step.design);
  const std::unique_ptr<BoxTest> unit = make_box_test(design, example.bits);
  EXPECT_FALSE(is_false_miss(*unit, c));
  EXPECT_TRUE(is_false_miss(*example.step.make(example.bits), c));
  if (example.step.set_up == nullptr) return;
  const std::vector<std::int64_t> right(unit->operands().begin(), unit->operands().end());
  std::vector<std::int64_t> written = right;
  example.step.set_up(c.ray, c.box, example.bits, written);
  const std::vector<rtl::Port> ports = design.ports(example.bits);
  const auto port =
      std::find_if(ports.begin(), ports.end(), [&](const rtl::Port& p) { return p.name == example.port; });
  ASSERT_NE(port, ports.end());
  const auto i = static_cast<std::size_t>(port - ports.begin());
  EXPECT_EQ(written[i], example.written);
  EXPECT_EQ(right[i], example.right);
}

TEST_P(TextAsWritten, IsInTheDocumentWithItsRayAndBox) {
  std::ifstream page(HITPIPE_SOURCE "/docs/never_misses.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  const AsWritten& example = GetParam();
  const std::string command = fmt::format("hitpipe check {} --bits {} --replay \\\n  \"{}\"",
                                          example.step.design, to_string(example.bits), example.replay);
  EXPECT_NE(text.find(command), std::string::npos) << command;
}

std::string name_of(const testing::TestParamInfo<Mutation>& parameter) {
  return parameter.param.name;
}
INSTANTIATE_TEST_SUITE_P(Examples, TextAsWritten, testing::ValuesIn(examples),
                         [](const auto& parameter) { return std::string(parameter.param.step.name); });
INSTANTIATE_TEST_SUITE_P(Faults, Mutations, testing::ValuesIn(faults), name_of);
INSTANTIATE_TEST_SUITE_P(Changes, HarmlessChanges, testing::ValuesIn(no_faults), name_of);

}  // namespace
}  // namespace hitpipe::sim::mutations_test
