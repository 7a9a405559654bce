// The hash is the published one.
#include "host/hash.hpp"

#include <string>

#include <gtest/gtest.h>

namespace hitpipe::host {
namespace {

std::uint64_t hash_of(const std::string& text) {
  return fnv1a(std::as_bytes(std::span(text)));
}

/// From the test suite of its authors.
TEST(Fnv1a, GivesThePublishedValues) {
  EXPECT_EQ(hash_of(""), 0xcbf29ce484222325U);
  EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8U);
}

TEST(Fnv1a, GoesOnFromWhatComesBefore) {
  const std::string rest = "bar";
  EXPECT_EQ(fnv1a(std::as_bytes(std::span(rest)), hash_of("foo")), hash_of("foobar"));
}

}  // namespace
}  // namespace hitpipe::host
