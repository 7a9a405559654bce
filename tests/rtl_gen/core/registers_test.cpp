#include "rtl_gen/core/registers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/core/harness/register_word.hpp"

namespace hitpipe::rtl::registers_test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string words_of(const CoreOptions& options) {
  return register_words(core_registers(options));
}

TEST(CoreRegisterWords, SayWhatSoftwareKeepsAndWhatAResetMakes) {
  const std::string words = words_of({});
  EXPECT_THAT(words, HasSubstr("{0x00, 0x0, 0x48697470, Fit::largest, SoftReset::keeps, false, false}"));
  EXPECT_THAT(words, HasSubstr("{0x08, 0x0, 0x1, Fit::largest, SoftReset::keeps, true, false}"));
  EXPECT_THAT(words, HasSubstr("{0x0c, 0x0, 0x0, Fit::largest, SoftReset::keeps, false, false}"));
  EXPECT_THAT(words, HasSubstr("{0x10, 0xffffffc0, 0x0, Fit::cut, SoftReset::keeps, true, false}"));
  EXPECT_THAT(words, HasSubstr("{0x1c, 0xfffff, 0xfffff, Fit::largest, SoftReset::keeps, true, false}"));
  EXPECT_THAT(words, HasSubstr("{0x20, 0x3f, 0x0, Fit::largest, SoftReset::holds, true, false}"));
  EXPECT_THAT(words, HasSubstr("{0x40, 0x0, 0x0, Fit::largest, SoftReset::keeps, false, true},  // CYCLES"));
  EXPECT_THAT(words, HasSubstr("{0x44, 0x0, 0x0, Fit::largest, SoftReset::keeps, false, true},  // CYCLES"));
  for (const char* const absent : {"MOST_LINES", "OFFERED", "CACHE_HITS"})
    EXPECT_THAT(words, Not(HasSubstr(absent)));
}

TEST(CoreRegisterWords, AreThoseOfOneCore) {
  const std::string words = words_of({.byte_bits = 40, .float_door = true, .cache = {2}, .rings = true});
  EXPECT_THAT(words, HasSubstr("{0x14, 0xff, 0x0, Fit::cut, SoftReset::keeps, true, false},  // BASE_HIGH"));
  EXPECT_THAT(words, HasSubstr("{0x34, 0x3f, 0x8, Fit::from_one, SoftReset::keeps, true, false}"));
  // To write it sets the core to work.
  EXPECT_THAT(words, HasSubstr("{0xac, 0xffff, 0x0, Fit::largest, SoftReset::clears, false, false}"));
  EXPECT_THAT(words, HasSubstr("{0xb0, 0x1ffff, 0x0, Fit::largest, SoftReset::keeps, true, false}"));
  // A word without bits is written too: it stays 0.
  EXPECT_THAT(words_of({.byte_bits = 32}),
              HasSubstr("{0x14, 0x0, 0x0, Fit::cut, SoftReset::keeps, true, false},  // BASE_HIGH"));
}

TEST(HarnessRegisterWord, TakesWhatFits) {
  const auto fitting = [](Fit fit, std::uint32_t kept, std::uint32_t written) {
    return RegisterWord{0, kept, 0, fit, SoftReset::keeps, true, false}.fitting(written);
  };
  EXPECT_EQ(fitting(Fit::largest, 0x3f, 0x3e), 0x3eU);
  EXPECT_EQ(fitting(Fit::largest, 0x3f, 0x40), 0x3fU);
  EXPECT_EQ(fitting(Fit::largest, 0x3f, 0), 0U);
  EXPECT_EQ(fitting(Fit::from_one, 0x3f, 0), 1U);
  EXPECT_EQ(fitting(Fit::from_one, 0x3f, 0x80000000), 0x3fU);
  EXPECT_EQ(fitting(Fit::cut, 0xffffffc0, 0x8000007f), 0x80000040U);
  EXPECT_EQ(fitting(Fit::cut, 0, 0xffffffff), 0U);
}

}  // namespace
}  // namespace hitpipe::rtl::registers_test
