// Features go together, or say that they do not: each set of them is allowed, or is refused with a line that names two
// that exclude each other. Of up to three, all parts are joined and the files are written.
#include "tests/rtl_gen/core/feature_pairs.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "rtl_gen/core/system_rdl.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::feature_pairs_test {
namespace {

using testing::HasSubstr;

std::string message(const CoreOptions& options) {
  return message_of<std::runtime_error>([&] { check_core_options(options); });
}

/// So many features or fewer, with what these need. The bus differs from one to the next.
struct Subset {
  Features features;
  CoreOptions options;
};
std::vector<Subset> subsets(std::size_t most) {
  const Features all = choices();
  std::vector<Subset> made;
  for (std::size_t number = 0; number < std::size_t{1} << all.size(); ++number) {
    Features features;
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((number >> i & 1) != 0) features.push_back(all[i]);
    if (features.size() > most) continue;
    features = with_needs(features);
    if (std::ranges::count(made, features, &Subset::features) == 0)
      made.push_back({features, small_core(features, made.size())});
  }
  return made;
}

TEST(Features, AreRefusedInPairsAlone) {
  int refused = 0;
  for (const auto& [features, options] : subsets(choices().size())) {
    const std::optional<FeaturePair> excluded = exclusion(features);
    SCOPED_TRACE(options_json(options).dump());
    EXPECT_EQ(is_core(options), !excluded);
    if (!excluded) continue;
    ++refused;
    EXPECT_THAT(message(options), AllOf(HasSubstr(excluded->first->what), HasSubstr(excluded->second->what)));
  }
  EXPECT_GT(refused, 0);
}

/// Of three features that may stand together, all is joined.
TEST(Features, MakeACore) {
  std::vector<CoreOptions> allowed;
  for (const auto& [features, options] : subsets(3)) {
    if (exclusion(features)) continue;
    Features is = features_of(options);
    std::erase_if(is, [](const Feature* each) { return each->is_in(CoreOptions{}); });
    EXPECT_EQ(is, features);
    allowed.push_back(options);
  }
  const Library& library = Library::thesis();
  for (const Core& core : make_cores(allowed, library, "core")) {
    SCOPED_TRACE(options_json(core.options).dump());
    EXPECT_EQ(verify(assembly_of(core)), std::vector<std::string>{});
    EXPECT_EQ(verify(behind_axi(core)), std::vector<std::string>{});
    EXPECT_THAT(to_verilog(core, library), HasSubstr("module core ("));
    EXPECT_THAT(axi_verilog(core), HasSubstr("module core_axi ("));
    EXPECT_THAT(c_header(core), HasSubstr("core_unpack_hit"));
    EXPECT_THAT(system_rdl(core), HasSubstr("addrmap"));
  }
}

/// A feature alone, without one that it needs.
TEST(FeatureNeeds, AreNamed) {
  int needs = 0;
  for (const Feature* const each : choices())
    for (const Needs& other : each->needs) {
      ++needs;
      const std::string said = message(small_core({each}));
      EXPECT_THAT(said, AllOf(HasSubstr(each->what), HasSubstr(other.otherwise)));
    }
  EXPECT_GT(needs, 0);
}

/// All pairs that may stand together are met, on each bus.
TEST(PairedCores, HaveEachBus) {
  std::set<std::pair<int, bool>> buses;
  for (const PairedCore& each : paired_cores()) {
    buses.emplace(each.options.data_bits, each.options.in_order);
    EXPECT_TRUE(each.pair.first->is_in(each.options) && each.pair.second->is_in(each.options));
  }
  EXPECT_EQ(buses, (std::set<std::pair<int, bool>>{
                       {64, false}, {128, false}, {256, false}, {512, false}, {256, true}}));
}

TEST(SomePairedCores, HaveEachFeatureThatHasAPartner) {
  std::set<const Feature*> met, expected;
  for (const PairedCore& each : paired_cores()) expected.insert({each.pair.first, each.pair.second});
  for (const PairedCore& each : some_paired_cores()) met.insert({each.pair.first, each.pair.second});
  EXPECT_EQ(met, expected);
  EXPECT_LE(some_paired_cores().size(), choices().size());
}

}  // namespace
}  // namespace hitpipe::rtl::feature_pairs_test
