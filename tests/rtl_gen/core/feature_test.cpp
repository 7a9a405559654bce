#include "rtl_gen/core/feature.hpp"

#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rtl_gen/core/registers.hpp"

namespace hitpipe::rtl::feature_test {
namespace {

using hls::registers::Access;

TEST(CoreIdentity, HasTheFieldsOfTheTable) {
  CoreIdentity identity;
  identity.put("coord", 0x14);
  identity.put("mantissa", 0xb);
  identity.put("eight_ways", 1);
  EXPECT_EQ(identity["FORMAT"], 0x0b000014U);
  EXPECT_EQ(identity["LIMITS"], 0x10000000U);
  EXPECT_EQ(identity["PORTS"], 0U);
  EXPECT_EQ(identity["STATUS"], 0U);
}

TEST(CoreIdentity, RefusesWhatTheTableDoesNotSay) {
  CoreIdentity identity;
  for (const char* const name : {"", "colour", "FORMAT", "idle", "version"})
    EXPECT_THROW(identity.put(name, 0), std::logic_error) << name;
}

TEST(CoreIdentity, RefusesANumberThatDoesNotFitOrComesTwice) {
  CoreIdentity identity;
  EXPECT_THROW(identity.put("finer", 16), std::logic_error);
  EXPECT_THROW(identity.put("finer", -1), std::logic_error);
  identity.put("finer", 0);
  EXPECT_THROW(identity.put("finer", 0), std::logic_error);
}

// The names of its fields differ, so that each is a place.
TEST(CoreIdentity, HasAllFieldsOrIsRefused) {
  std::set<std::string_view> names;
  for (const hls::registers::Register& each : hls::registers::table)
    for (const hls::registers::RegisterField& field : each.fields)
      if (field.access == Access::constant && field.reset == 0) {
        EXPECT_TRUE(names.insert(field.name).second) << field.name;
      }
  EXPECT_EQ(names.size(), 26U);
  for (const std::string_view missing : names) {
    CoreIdentity identity;
    for (const std::string_view name : names)
      if (name != missing) identity.put(name, 1);
    EXPECT_THROW(identity.check(), std::logic_error) << missing;
    identity.put(missing, 1);
    EXPECT_NO_THROW(identity.check());
  }
}

TEST(CoreIdentity, IsWholeWithAnyFeatures) {
  EXPECT_NO_THROW((void)identity_of({}));
  EXPECT_NO_THROW(
      (void)identity_of({.serial_triangle = true, .float_door = true, .cache = {2}, .rings = true}));
  EXPECT_NO_THROW((void)identity_of({.weights = true, .questions = true}));
}

}  // namespace
}  // namespace hitpipe::rtl::feature_test
