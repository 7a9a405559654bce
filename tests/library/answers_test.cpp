// Operands, HIT, results and exact answers of the library, against the program's.
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sim/software/box_software.hpp"
#include "sim/software/software.hpp"
#include "tests/library/cases.hpp"

namespace hitpipe {
namespace {

using testing::ElementsAreArray;

/// The default format, and one that has no instance of its own.
std::vector<std::string> formats_of(const rtl::Design& design) {
  std::vector<std::string> formats{to_string(design.default_format)};
  const std::vector<Format>& swept = sim::software_of(design).sweep_formats;
  if (!swept.empty() && swept.front() != design.default_format) formats.push_back(to_string(swept.front()));
  return formats;
}

TEST(LibraryAnswers, AreThoseOfTheProgramForEveryDesignOfOneBox) {
  std::size_t tests = 0;
  for (const rtl::Design& design : rtl::designs()) {
    if (design.kind.objects != 1 || !design.kind.of_boxes) continue;
    for (const std::string& bits : formats_of(design)) {
      SCOPED_TRACE(std::string(design.name) + " " + bits);
      const auto expected = sim::make_box_test(design, design.parse_format(bits));
      Unit unit(std::string(design.name), bits);
      for (const LibraryCase& c : library_cases(20, 1)) {
        SCOPED_TRACE(to_text(c.own));
        expected->start(c.own.ray);
        unit.set_ray(c.ray);
        const Answers answers = unit.test(c.box);
        ASSERT_EQ(answers.hit[0] != 0, expected->hit(c.own.box));
        ASSERT_THAT(answers.operands, ElementsAreArray(expected->operands()));
        ASSERT_THAT(answers.results, ElementsAreArray(expected->results()));
        ASSERT_EQ(answers.exact[0] != 0, ref::ray_meets_box_exact(c.own.ray, c.own.box));
        ASSERT_EQ(exact(c.ray, c.box), answers.exact[0] != 0);
        ++tests;
      }
    }
  }
  EXPECT_GE(tests, 6 * library_cases(20, 1).size());
}

TEST(LibraryAnswers, OfTwoBoxesAreThoseOfTheUnitForOneBox) {
  const auto cases = library_cases(40, 2);
  Unit pair("int_major_pair", "20+1/13");
  Unit one("int_major", "20+1/13");
  ASSERT_EQ(pair.boxes_per_test(), 2U);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(to_text(cases[i].own));
    const std::vector<Box> boxes{cases[i].box, cases[(i + 1) % cases.size()].box};
    pair.set_ray(cases[i].ray);
    one.set_ray(cases[i].ray);
    const Answers both = pair.test(boxes);
    const Answers each = one.test(boxes);
    ASSERT_EQ(both.hit, each.hit);
    ASSERT_EQ(both.exact, each.exact);
    hits += both.hit[0] + both.hit[1];
    // The results belong to the test of both, or to the parent's test if the ray misses it.
    ASSERT_EQ(both.results[0] != 0, both.hit[0] != 0);
  }
  EXPECT_GT(hits, 100U);
}

/// The operands of a test, and others that no set-up gives: every port at an end of what its bits hold.
TEST(LibraryAnswers, OfOperandsAloneAreTheResultsOfTheirTests) {
  for (const rtl::Design& design : rtl::designs()) {
    SCOPED_TRACE(design.name);
    Unit unit{std::string(design.name)};
    const rtl::Evaluate evaluate = design.evaluate(design.default_format);
    std::vector<std::int64_t> operands;
    std::vector<std::int64_t> results;
    if (sim::software_of(design).box_test != nullptr) {
      for (const LibraryCase& c : library_cases(5, 4)) {
        unit.set_ray(c.ray);
        const Answers answers = unit.test(std::vector<Box>(unit.boxes_per_test(), c.box));
        operands.insert(operands.end(), answers.operands.begin(), answers.operands.end());
        results.insert(results.end(), answers.results.begin(), answers.results.end());
      }
    }
    for (const bool high : {false, true}) {
      std::vector<std::int64_t> ends;
      for (const rtl::Port& port : design.ports(design.default_format))
        ends.push_back(high ? numbers_of(port).high : numbers_of(port).low);
      operands.insert(operands.end(), ends.begin(), ends.end());
      results.resize(results.size() + evaluate.result_count());
      evaluate(ends.data(), &results[results.size() - evaluate.result_count()]);
    }
    ASSERT_EQ(unit.test_operands(operands), results);
  }
}

TEST(LibraryAnswers, OfManyBoxesAreThoseOfEach) {
  const auto cases = library_cases(10, 3);
  std::vector<Box> boxes;
  for (const LibraryCase& c : cases) boxes.push_back(c.box);
  Unit unit("int_plucker", "16/16");
  unit.set_ray(cases[7].ray);
  const Answers all = unit.test(boxes);
  std::vector<std::uint8_t> hits(boxes.size());
  unit.hits(boxes, hits);
  EXPECT_EQ(all.hit, hits);
  const std::size_t ports = unit.ports().size();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Answers one = unit.test(boxes[i]);
    ASSERT_EQ(one.hit[0], all.hit[i]);
    ASSERT_EQ(one.exact[0], all.exact[i]);
    ASSERT_THAT(one.operands,
                ElementsAreArray(all.operands.begin() + static_cast<std::ptrdiff_t>(i * ports),
                                 all.operands.begin() + static_cast<std::ptrdiff_t>((i + 1) * ports)));
  }
  EXPECT_TRUE(unit.test(std::span<const Box>{}).hit.empty());
}

TEST(LibraryAnswers, ADesignWithoutBoxesTakesOperandsOnly) {
  Unit unit("int_triangle");
  EXPECT_EQ(unit.ports().size(), 17U);
  EXPECT_THROW(unit.set_ray(library_cases(1, 4).front().ray), std::exception);
}

TEST(LibraryAnswers, OperandsStayInTheRangesOfTheirPorts) {
  for (const DesignInfo& design : designs()) {
    if (!rtl::find_design(design.name).kind.of_boxes) continue;
    Unit unit(design.name);
    for (const LibraryCase& c : library_cases(10, 4)) {
      unit.set_ray(c.ray);
      const Answers answers = unit.test(std::vector<Box>(unit.boxes_per_test(), c.box));
      for (std::size_t i = 0; i < unit.ports().size(); ++i) {
        ASSERT_GE(answers.operands[i], unit.ports()[i].min) << design.name << " " << unit.ports()[i].name;
        ASSERT_LE(answers.operands[i], unit.ports()[i].max) << design.name << " " << unit.ports()[i].name;
      }
    }
  }
}

TEST(LibraryAnswers, PortBitsAreCutToTheWidth) {
  EXPECT_EQ(hitpipe_bits(-1, 12), 0xFFFU);
  EXPECT_EQ(hitpipe_bits(5, 12), 5U);
  EXPECT_EQ(hitpipe_bits(-2, 64), ~std::uint64_t{1});
  Unit unit("int_slabs", "12/12");
  unit.set_ray({{-0.5F, 0, 0}, {1, 0, 0}, endless});
  const Answers answers = unit.test({{-0.25F, -0.25F, -0.25F}, {0.25F, 0.25F, 0.25F}});
  const std::vector<std::uint64_t> bits = unit.port_bits(answers.operands);
  ASSERT_EQ(bits.size(), unit.ports().size());
  EXPECT_LT(answers.operands[0], 0);
  EXPECT_EQ(bits[0], static_cast<std::uint64_t>(answers.operands[0] + 4096));
}

TEST(LibraryAnswers, ThreadsWithAUnitEachDoNotDisturbEachOther) {
  const auto cases = library_cases(10, 5);
  const auto answers_of = [&] {
    Unit unit("int_slabs", "14/16");
    std::vector<std::int64_t> all;
    for (const LibraryCase& c : cases) {
      unit.set_ray(c.ray);
      const Answers answers = unit.test(c.box);
      all.insert(all.end(), answers.operands.begin(), answers.operands.end());
      all.push_back(answers.hit[0] * 2 + answers.exact[0]);
    }
    return all;
  };
  const auto expected = answers_of();
  std::vector<std::vector<std::int64_t>> found(4);
  std::vector<std::string> errors(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i) {
    threads.emplace_back([&, i] {
      hitpipe_unit* none = nullptr;
      static_cast<void>(hitpipe_open("int_slabs", std::to_string(i).c_str(), &none));
      found[i] = answers_of();
      errors[i] = hitpipe_error();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i], expected);
    EXPECT_THAT(errors[i], testing::StartsWith("bits " + std::to_string(i) + ": no format of int_slabs"));
  }
}

}  // namespace
}  // namespace hitpipe
