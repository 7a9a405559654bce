// Two features that may stand together: the files of a core that has both pass in the tools. Each feature is in a pair,
// and with HITPIPE_ALL_PAIRS each pair is tested.
#include "tests/rtl_gen/core/feature_pairs.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/core/files.hpp"
#include "sim/core/core_vectors.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sim/core/run_make.hpp"

namespace hitpipe::sim::feature_pairs_test {
namespace {

using testing::HasSubstr;

bool are_all() {
  return std::getenv("HITPIPE_ALL_PAIRS") != nullptr;
}

/// What has come of a pair, for a page.
std::string entry(const rtl::FeaturePair& pair, const std::map<std::string, bool>& passed) {
  const auto excluded = rtl::exclusion(rtl::with_needs(pair.features()));
  if (!excluded) return passed.at(pair.name()) ? "runs" : "FAILS";
  const auto says =
      std::ranges::find(excluded->first->excludes, excluded->second->name, &rtl::Excludes::feature);
  return fmt::format("{}: only with {}", excluded->first->name, says->instead);
}

/// Runs the files of pairs, and prints what came of each when all were run.
class PairedCore : public testing::TestWithParam<rtl::PairedCore> {
 public:
  static void TearDownTestSuite() {
    if (!are_all() || passed_.size() != rtl::paired_cores().size()) return;
    fmt::print("| features | | together |\n|---|---|---|\n");
    for (const rtl::FeaturePair& pair : rtl::feature_pairs())
      fmt::print("| `{}` | `{}` | {} |\n", pair.first->name, pair.second->name, entry(pair, passed_));
  }

 protected:
  void TearDown() override { passed_[GetParam().pair.name()] = !HasFailure(); }

 private:
  static inline std::map<std::string, bool> passed_;
};

TEST_P(PairedCore, PassesInAllTools) {
  const rtl::Library library = rtl::library_called(rtl::default_library);
  const rtl::Core core = rtl::make_core(GetParam().options, library, "core");
  const host::ScratchFolder folder("feature-pairs");
  host::write_files(folder.path(), rtl::core_files(core, library, core_test(core, 1000, 7)));
  rtl::expect_silent_tools(folder.path(), {{"core_axi", "core"}});
  const rtl::ToolResult replayed = run_make(folder.path(), "icarus-core");
  EXPECT_EQ(replayed.status, 0) << replayed.output;
  EXPECT_THAT(replayed.output, HasSubstr("PASS 1000 cycles"));
  const rtl::ToolResult system = run_make(folder.path(), "harness");
  EXPECT_EQ(system.status, 0) << system.output;
  EXPECT_THAT(system.output, HasSubstr("PASS 1000 rays"));
}

INSTANTIATE_TEST_SUITE_P(Features, PairedCore,
                         testing::ValuesIn(are_all() ? rtl::paired_cores() : rtl::some_paired_cores()),
                         [](const auto& each) { return each.param.pair.name(); });

}  // namespace
}  // namespace hitpipe::sim::feature_pairs_test
