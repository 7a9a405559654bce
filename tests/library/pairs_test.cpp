// Many rays, each with its own boxes, in one call: the answers of the same calls one by one.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/software/software.hpp"
#include "tests/library/cases.hpp"
#include "tests/message_of.hpp"

namespace hitpipe {
namespace {

struct Pairs {
  std::vector<Ray> rays;
  std::vector<Box> boxes;
};

Pairs pairs_of(std::size_t boxes_per_test, std::uint64_t seed) {
  const auto cases = library_cases(20, seed);
  Pairs pairs;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    pairs.rays.push_back(cases[i].ray);
    for (std::size_t box = 0; box < boxes_per_test; ++box)
      pairs.boxes.push_back(cases[(i + box) % cases.size()].box);
  }
  return pairs;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// The default format, one that has no instance of its own, and one of the integer world.
std::vector<std::string> formats_of(const DesignInfo& design) {
  std::vector<std::string> formats{""};
  const auto& swept = sim::software_of(rtl::find_design(design.name)).sweep_formats;
  if (!swept.empty()) formats.push_back(to_string(swept.front()));
  const std::string of_integer_world = "20+1/11s20";
  if (hitpipe_check_format(design.name, of_integer_world.c_str()) == HITPIPE_OK)
    formats.push_back(of_integer_world);
  return formats;
}

void expect_those_of_one_call_each(Unit& unit, const Pairs& pairs) {
  Answers expected;
  for (std::size_t i = 0; i < pairs.rays.size(); ++i) {
    unit.set_ray(pairs.rays[i]);
    const Answers one =
        unit.test(std::span(pairs.boxes).subspan(i * unit.boxes_per_test(), unit.boxes_per_test()));
    append(expected.hit, one.hit);
    append(expected.exact, one.exact);
    append(expected.operands, one.operands);
    append(expected.results, one.results);
  }
  const Answers found = unit.test_pairs(pairs.rays, pairs.boxes);
  EXPECT_EQ(found.hit, expected.hit);
  EXPECT_EQ(found.exact, expected.exact);
  EXPECT_EQ(found.operands, expected.operands);
  EXPECT_EQ(found.results, expected.results);
  EXPECT_GT(std::ranges::count(found.hit, 1), 50);
  EXPECT_GT(std::ranges::count(found.hit, 0), 50);
}

TEST(LibraryPairs, AnswersAreThoseOfOneCallEachForEveryDesign) {
  std::size_t units = 0;
  for (const DesignInfo& design : designs()) {
    for (const std::string& format : formats_of(design)) {
      SCOPED_TRACE(std::string(design.name) + " " + format);
      Unit unit(design.name, format);
      const Pairs pairs = pairs_of(unit.boxes_per_test(), 6);
      if (rtl::find_design(design.name).kind.of_boxes) {
        expect_those_of_one_call_each(unit, pairs);
        ++units;
      } else {
        EXPECT_EQ(message_of([&] { static_cast<void>(unit.test_pairs(pairs.rays, pairs.boxes)); }),
                  "design " + std::string(design.name) + ": tests no boxes; give it operands");
      }
    }
  }
  EXPECT_GE(units, 14U);
}

TEST(LibraryPairs, ExactAnswersAreThoseOfOneCallEach) {
  const Pairs pairs = pairs_of(1, 7);
  std::vector<std::uint8_t> met(pairs.rays.size(), 7);
  check(hitpipe_exact_pairs(pairs.rays.data(), pairs.boxes.data(), met.size(), met.data()));
  for (std::size_t i = 0; i < met.size(); ++i)
    ASSERT_EQ(met[i] != 0, exact(pairs.rays[i], pairs.boxes[i])) << i;
}

TEST(LibraryPairs, WritesOnlyWhatIsAsked) {
  const Pairs pairs = pairs_of(1, 8);
  Unit unit("int_major");
  const std::size_t count = pairs.rays.size();
  const Answers all = unit.test_pairs(pairs.rays, pairs.boxes);
  std::vector<std::uint8_t> exact_only(count);
  const hitpipe_answers places{nullptr, exact_only.data(), nullptr, nullptr};
  check(hitpipe_test_pairs(unit.handle(), pairs.rays.data(), pairs.boxes.data(), count, &places));
  EXPECT_EQ(exact_only, all.exact);
  const hitpipe_answers none{};
  check(hitpipe_test_pairs(unit.handle(), pairs.rays.data(), pairs.boxes.data(), count, &none));
  check(hitpipe_test_pairs(unit.handle(), nullptr, nullptr, 0, &none));
  check(hitpipe_exact_pairs(nullptr, nullptr, 0, nullptr));
}

/// The status and the line, for every design, with the bad ray or box in the midst.
TEST(LibraryPairs, NamesTheFirstBadRayOrBoxAndWritesNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const DesignInfo& design : designs()) {
    if (!rtl::find_design(design.name).kind.of_boxes) continue;
    SCOPED_TRACE(design.name);
    Unit unit(design.name);
    const Pairs good = pairs_of(unit.boxes_per_test(), 9);
    const Answers before = unit.test_pairs(good.rays, good.boxes);
    const auto refused = [&](const Pairs& pairs, hitpipe_status status, const std::string& line) {
      Answers after = before;
      for (auto* flags : {&after.hit, &after.exact}) std::ranges::fill(*flags, std::uint8_t{7});
      for (auto* numbers : {&after.operands, &after.results}) std::ranges::fill(*numbers, 7);
      const hitpipe_answers places{after.hit.data(), after.exact.data(), after.operands.data(),
                                   after.results.data()};
      EXPECT_EQ(hitpipe_test_pairs(unit.handle(), pairs.rays.data(), pairs.boxes.data(), pairs.rays.size(),
                                   &places),
                status);
      EXPECT_EQ(hitpipe_error(), line);
      for (const auto& flags : {after.hit, after.exact}) EXPECT_THAT(flags, testing::Each(7));
      for (const auto& numbers : {after.operands, after.results}) EXPECT_THAT(numbers, testing::Each(7));
    };
    Pairs bad = good;
    const std::size_t last = bad.boxes.size() - 1;
    bad.boxes[last].max[2] = nan;
    const std::string bad_box =
        "box " + std::to_string(last) + ": max.z = nan is outside the cube; allowed is [-1, 1]";
    refused(bad, HITPIPE_BAD_BOX, bad_box);
    // All rays are looked at before the boxes.
    bad.rays[7].origin[1] = 1.5F;
    bad.rays[9].length = -1;
    refused(bad, HITPIPE_BAD_RAY, "ray 7: origin.y = 1.5 is outside the cube; allowed is [-1, 1]");
    bad.rays[7] = good.rays[7];
    refused(bad, HITPIPE_BAD_RAY, "ray 9: length = -1; it must be >= 0 or infinite");
    std::ranges::fill(bad.rays[8].direction, 0.0F);
    refused(bad, HITPIPE_BAD_RAY, "ray 8: direction is (0, 0, 0); one component must differ from 0");
    std::uint8_t met = 7;
    EXPECT_EQ(hitpipe_exact_pairs(bad.rays.data() + 8, bad.boxes.data(), 1, &met), HITPIPE_BAD_RAY);
    EXPECT_EQ(hitpipe_exact_pairs(good.rays.data(), &bad.boxes[last], 1, &met), HITPIPE_BAD_BOX);
    EXPECT_EQ(met, 7);
  }
}

TEST(LibraryPairs, LeavesNoRayUnlessItFails) {
  Unit unit("int_slabs");
  Pairs pairs = pairs_of(1, 10);
  unit.set_ray(pairs.rays[3]);
  const Answers before = unit.test(pairs.boxes[3]);
  const Ray good = pairs.rays[0];
  pairs.rays[0].origin[0] = 2;
  EXPECT_THROW(static_cast<void>(unit.test_pairs(pairs.rays, pairs.boxes)), Error);
  EXPECT_EQ(unit.test(pairs.boxes[3]).operands, before.operands);
  pairs.rays[0] = good;
  static_cast<void>(unit.test_pairs(pairs.rays, pairs.boxes));
  EXPECT_EQ(message_of([&] { static_cast<void>(unit.test(pairs.boxes[3])); }),
            "design int_slabs: no ray is set; set one before a test");
}

TEST(LibraryPairs, WrongNumbersAndNullPointersAreNamed) {
  Unit unit("int_major_pair");
  const Pairs pairs = pairs_of(1, 11);
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] {
        static_cast<void>(unit.test_pairs(std::span(pairs.rays).first(2), std::span(pairs.boxes).first(3)));
      }),
      "test_pairs: 2 rays and 3 boxes; a test has 2 for its ray");
  std::uint8_t met = 0;
  const hitpipe_answers out{&met, nullptr, nullptr, nullptr};
  const Ray* const rays = pairs.rays.data();
  const Box* const boxes = pairs.boxes.data();
  const auto refused = [](const char* name, hitpipe_status status) {
    EXPECT_EQ(status, HITPIPE_BAD_ARGUMENT) << name;
    EXPECT_EQ(hitpipe_error(), std::string(name) + ": a null pointer is not allowed");
  };
  refused("unit", hitpipe_test_pairs(nullptr, rays, boxes, 1, &out));
  refused("rays", hitpipe_test_pairs(unit.handle(), nullptr, boxes, 1, &out));
  refused("boxes", hitpipe_test_pairs(unit.handle(), rays, nullptr, 1, &out));
  refused("out", hitpipe_test_pairs(unit.handle(), rays, boxes, 1, nullptr));
  refused("rays", hitpipe_exact_pairs(nullptr, boxes, 1, &met));
  refused("boxes", hitpipe_exact_pairs(rays, nullptr, 1, &met));
  refused("met", hitpipe_exact_pairs(rays, boxes, 1, nullptr));
  EXPECT_EQ(hitpipe_test_pairs(unit.handle(), rays, boxes, SIZE_MAX, &out), HITPIPE_FAILED);
  EXPECT_STREQ(hitpipe_error(), "out of memory");
}

}  // namespace
}  // namespace hitpipe
