// Cases as text: they are read back bit for bit, and an error names the word that cannot be read.
#include "sw_ref/judge/adversary/case.hpp"

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

namespace hitpipe::ref::adversary::case_test {
namespace {

constexpr std::uint64_t seed = 20075;
const std::string good = "origin 0 0 0 direction 1 0 0 length inf box 0.5 -0.5 -0.5 to 1 0.5 0.5";

void rejected(const std::string& text, const std::string& message) {
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)parse_case(text); }), "case: " + message) << text;
}

void unreadable(const std::string& text, const std::string& word, const std::string& wanted) {
  rejected(text, "\"" + word + "\" where " + wanted +
                     " is wanted; the form is: origin X Y Z direction X Y Z length L box X Y Z to X Y Z");
}

/// The good case with the first occurrence of `was` replaced.
std::string with(const std::string& was, const std::string& is) {
  std::string text = good;
  return text.replace(text.find(was), was.size(), is);
}

TEST(ParseCase, ReadsBackWhatIsWrittenToTheBit) {
  static_assert(sizeof(Case) == 13 * sizeof(float), "no gap between numbers");
  Random random(seed);
  each_case(random, 1'000, [](const Case& c) {
    const Case read = parse_case(to_text(c));
    ASSERT_EQ(std::memcmp(&read, &c, sizeof c), 0);
  });
}

TEST(ParseCase, ReadsDecimalHexadecimalAndInfiniteNumbersAndAnyBlanks) {
  const Case c =
      parse_case("  origin 0.1 -1e-3 0x1p-4\n direction -0 2.5 0x1.8p+1\tlength INF box -1 -1 -1 to 1 1 1 ");
  EXPECT_EQ(c.ray.origin, glm::vec3(0.1F, -1e-3F, 0.0625F));
  EXPECT_TRUE(std::signbit(c.ray.direction.x));
  EXPECT_EQ(c.ray.direction.z, 3.0F);
  EXPECT_TRUE(c.ray.is_infinite());
}

TEST(ParseCase, WordsInTheWrongPlaceRejected) {
  unreadable("", "", "\"origin\"");
  unreadable("ray 0 0 0", "ray", "\"origin\"");
  unreadable("origin 0 0", "", "a number");
  unreadable("origin 0 0 0 0 direction", "0", "\"direction\"");
  unreadable(with("origin 0 0 0", "origin 0 0"), "direction", "a number");
  unreadable(with("length inf", "length"), "box", "a number");
  unreadable(with("length", "lenght"), "lenght", "\"length\"");
  unreadable(with("box", "boxes"), "boxes", "\"box\"");
  unreadable(with(" to", " and"), "and", "\"to\"");
  unreadable(with("1 0.5 0.5", "1 0.5"), "", "a number");
  unreadable(good + " 7", "7", "the end");
}

TEST(ParseCase, WordsThatAreNoNumberRejected) {
  unreadable(with("origin 0", "origin zero"), "zero", "a number");
  unreadable(with("origin 0", "origin 0x"), "0x", "a number");
  unreadable(with("origin 0", "origin 1,5"), "1,5", "a number");
  unreadable(with("length inf", "length infinite"), "infinite", "a number");
}

TEST(ParseCase, RefusedRayRejected) {
  const std::string message =
      "the ray is refused; its origin must lie in [-1, 1]^3, its direction be finite and not 0, its length "
      ">= 0 or inf";
  for (const auto& [was, is] : {std::pair{"origin 0", "origin 1.0000002"},
                                {"origin 0", "origin nan"},
                                {"direction 1", "direction 0"},
                                {"direction 1", "direction inf"},
                                {"direction 1", "direction nan"},
                                {"length inf", "length -0x1p-149"},
                                {"length inf", "length nan"}})
    rejected(with(was, is), message);
  EXPECT_NO_THROW((void)parse_case(with("length inf", "length -0")));
}

TEST(ParseCase, RefusedBoxRejected) {
  const std::string message = "the box is refused; it must lie in [-1, 1]^3 with min <= max on each axis";
  for (const auto& [was, is] : {std::pair{"to 1", "to 0.25"},
                                {"to 1", "to 1.0000002"},
                                {"-0.5 -0.5", "-0.5 -1.5"},
                                {"to 1", "to nan"},
                                {"to 1", "to inf"}})
    rejected(with(was, is), message);
}

}  // namespace
}  // namespace hitpipe::ref::adversary::case_test
