// Two cores live in one folder, one elaboration and one list of FuseSoC; software in C takes either.
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "rtl_gen/core/files.hpp"
#include "tests/rtl_gen/text.hpp"

namespace hitpipe::rtl::core_names_test {
namespace {

using testing::HasSubstr;

const CoreOptions small{.bits = parse_bits<hls::RayBits>("8+0/4s8")};

TEST(CoreNames, OfTheModuleSayTheFormatUnlessItIsTheDefault) {
  EXPECT_EQ(CoreOptions{}.module(), "hitpipe_core");
  EXPECT_EQ(small.module(), "hitpipe_core_8p0_4s8");
  EXPECT_EQ(make_core(small, Library::thesis()).module, "hitpipe_core_8p0_4s8");
}

TEST(CoreNames, AreTheUsersInEveryFile) {
  const Core core = make_core(small, Library::thesis(), "mine");
  for (const host::File& file : core_files(core, Library::thesis(), {})) {
    SCOPED_TRACE(file.name);
    EXPECT_THAT(file.contents, Not(HasSubstr("hitpipe_core")));
    if (file.name != "tb/Makefile") {
      EXPECT_THAT(file.name, HasSubstr("mine"));
    }
    if (file.name.ends_with(".core")) {
      EXPECT_THAT(file.contents, HasSubstr("\nname: \"hitpipe:core:mine:"));
    }
    if (!file.name.ends_with(".v")) continue;
    const std::regex module("\nmodule (\\w+)");
    for (std::sregex_iterator at(file.contents.begin(), file.contents.end(), module), end; at != end; ++at)
      EXPECT_THAT((*at)[1].str(), testing::StartsWith("mine"));
  }
}

TEST(CoreNames, InTheCHeaderAreThoseOfEveryCore) {
  const auto header = [](const std::string& module, const std::string& guard) {
    std::string text = c_header(make_core(small, Library::thesis(), module));
    for (const std::string& own : {module + "_axi", guard, guard}) text = replaced(text, own, "");
    return text;
  };
  EXPECT_EQ(header("one", "ONE_H"), header("two", "TWO_H"));
  EXPECT_THAT(header("one", "ONE_H"),
              HasSubstr("static inline void core_pack_ray(uint8_t* bytes, const struct core_ray* ray)"));
}

}  // namespace
}  // namespace hitpipe::rtl::core_names_test
