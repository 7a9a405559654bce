// Words, CSV cells and numbers are read as they were written, and the hash is the published one.
#include "host/text.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::host {
namespace {

TEST(WordsOf, AreWhatBlanksSeparate) {
  EXPECT_THAT(words_of("  env\tg++  -O2\n"), testing::ElementsAre("env", "g++", "-O2"));
  EXPECT_THAT(words_of(" "), testing::IsEmpty());
}

TEST(Csv, LineHoldsItsCells) {
  const std::vector<std::string> cells{"", "a", "b,c", "\"", "say \"no\", twice", "d e", ""};
  const std::string line = csv_line(cells);
  EXPECT_EQ(line, ",a,\"b,c\",\"\"\"\",\"say \"\"no\"\", twice\",d e,\n");
  EXPECT_EQ(csv_cells(std::string_view(line).substr(0, line.size() - 1)), cells);
  EXPECT_EQ(csv_line(std::vector<std::string>{"two\nlines", "\r"}), "\"two\nlines\",\"\r\"\n");
  EXPECT_EQ(csv_line({}), "\n");
  // A spreadsheet would take the first for a date.
  const std::vector<std::string> formats{"12/12", "20+1/12", "1/", "/2", "12/12/12", "n12/12"};
  EXPECT_EQ(csv_line(formats), "n12/12,20+1/12,1/,/2,12/12/12,n12/12\n");
  EXPECT_THAT(csv_cells("n12/12,n20/x,n"), testing::ElementsAre("12/12", "n20/x", "n"));
}

TEST(Csv, OpenQuoteEndsWithTheLine) {
  EXPECT_THAT(csv_cells("a,\"b,c"), testing::ElementsAre("a", "b,c"));
  EXPECT_THAT(csv_cells(""), testing::ElementsAre(""));
}

TEST(NumberIn, IsTheWholeText) {
  EXPECT_EQ(number_in<int>("-12"), -12);
  EXPECT_EQ(number_in<double>("1e-3"), 1e-3);
  EXPECT_EQ(number_in<std::uint64_t>("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* const none : {"", " 1", "1 ", "+1", "1x", "0x1", "1.5"})
    EXPECT_EQ(number_in<int>(none), std::nullopt);
  for (const char* const none : {"", "1.5.", "1e", "1e999"}) EXPECT_EQ(number_in<double>(none), std::nullopt);
  EXPECT_EQ(number_in<unsigned>("-1"), std::nullopt);
  EXPECT_EQ(number_in<int>("2147483648"), std::nullopt);
}

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
