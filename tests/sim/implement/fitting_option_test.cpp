// What a unit that does not fit is told: an option that makes it fit, or that none of those tried does.
#include "sim/implement/fitting_option.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::fitting_option_test {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

/// A chip that has only so many of one resource. It is not placed, which takes less time.
Target with_at_most(const char* name, const std::string& resource, int available) {
  Target target = target_called(name);
  target.placer.reset();
  target.not_placed = "not in this test";
  for (Resource& each : target.resources)
    if (each.name == resource) each.available = available;
  return target;
}

struct Told {
  Implementation unit;
  std::string text;
};

Told told(const char* bits, const Target& target) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const Format format = design.parse_format(bits);
  const TemporaryFolder folder;
  const ImplementOptions options{.folder = folder.path(), .seeds = 0};
  Implementation unit = implement_unit(design, format, target, options);
  EXPECT_NE(unit.excess(), "");
  std::string text = fitting_option(design, format, target, options, unit);
  return {std::move(unit), std::move(text)};
}

std::vector<std::string> options_of(const std::vector<FittingCandidate>& candidates) {
  std::vector<std::string> options;
  for (const FittingCandidate& candidate : candidates) options.push_back(candidate.option);
  return options;
}

TEST(FittingCandidates, AreClocksThenIntervalsThenFormats) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const std::vector<FittingCandidate> all =
      fitting_candidates(design, design.parse_format("8/8"), target_called("ice40_up5k"), {});
  std::size_t clocks = 0;
  for (; all[clocks].option.starts_with("--clock-ps "); ++clocks)
    if (clocks > 0) {
      EXPECT_GT(*all[clocks].clock_ps, *all[clocks - 1].clock_ps);
    }
  EXPECT_GT(clocks, 1U);
  EXPECT_THAT(options_of({all.begin() + static_cast<std::ptrdiff_t>(clocks), all.end()}),
              ElementsAre("--ii 2", "--ii 3", "--ii 4", "--ii 6", "--bits 7/8", "--bits 6/8"));
}

TEST(FittingCandidates, AreNoneThatTheUnitHasAlready) {
  const rtl::Design& design = rtl::find_design("fp_slabs");
  EXPECT_THAT(options_of(fitting_candidates(design, design.default_format, target_called("ice40_up5k"),
                                            {.folder = {}, .clock_ps = 1'000'000, .interval = 3})),
              ElementsAre("--ii 4", "--ii 6"))
      << "no format of fp_slabs is smaller";
}

/// The unit with the option that is named.
Implementation unit_with(const std::string& option, const Target& target, const char* bits) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const Format format = design.parse_format(bits);
  for (const FittingCandidate& each : fitting_candidates(design, format, target, {})) {
    if (each.option != option) continue;
    const TemporaryFolder folder;
    return implement_unit(
        design, each.format, target,
        {.folder = folder.path(), .clock_ps = each.clock_ps, .interval = each.interval, .seeds = 0});
  }
  throw std::runtime_error(option + " is no candidate");
}

TEST(FittingOption, AnIntervalSavesBlocksAndThenTheUnitFits) {
  const Target target = with_at_most("ice40_up5k", "dsps", 4);
  EXPECT_EQ(told("8/8", target).text, "with --ii 2 it takes 3 of 4 dsps");
  const Implementation unit = unit_with("--ii 2", target, "8/8");
  EXPECT_EQ(unit.excess(), "");
  EXPECT_EQ(unit.count_of("dsps")->used, 3);
}

TEST(FittingOption, ALongerClockSavesRegistersAndThenTheUnitFits) {
  const Told free = told("6/6", with_at_most("ice40_hx", "registers", 1));
  EXPECT_EQ(free.text, "none of the options tried (a longer --clock-ps, --ii up to 6, fewer --bits) fits");
  const Target target = with_at_most("ice40_hx", "registers", free.unit.count_of("registers")->used - 1);
  const std::string text = told("6/6", target).text;
  ASSERT_THAT(text, StartsWith("with --clock-ps "));
  const std::string option = text.substr(5, text.find(" it takes ") - 5);
  const Implementation unit = unit_with(option, target, "6/6");
  EXPECT_EQ(unit.excess(), "");
  EXPECT_EQ(text, "with " + option + " it takes " + unit.count_of("registers")->text());
}

/// Counts of a unit that would take long to synthesise. No tool runs.
TEST(FittingOption, OfALargeUnitIsEstimated) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  Implementation unit;
  unit.counts = {{"luts", 20'000, {}}, {"dsps", 12, 8}};
  EXPECT_EQ(fitting_option(design, design.parse_format("16/16"), target_called("ice40_up5k"), {}, unit),
            "with --ii 2 it takes 6 of 8 dsps by estimate");
}

}  // namespace
}  // namespace hitpipe::sim::fitting_option_test
