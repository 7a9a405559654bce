// Files of rays and boxes become the operands, results and exact answers of a unit, in order.
#include "sim/operands/operands.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sim/operands/own_operands.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::operands_test {
namespace {

using ref::adversary::Case;

std::vector<Case> cases(std::size_t count) {
  ref::adversary::Random random(1);
  const auto all = ref::adversary::categories();
  std::vector<Case> made;
  for (std::size_t i = 0; i < count; ++i) made.push_back(all[i % all.size()].make(random));
  return made;
}

std::string ray_line(const ref::Ray& r) {
  return fmt::format("{:a},{:a},{:a},{:a},{:a},{:a},{:a}\n", r.origin.x, r.origin.y, r.origin.z,
                     r.direction.x, r.direction.y, r.direction.z, r.length);
}
std::string box_line(const ref::Aabb& b) {
  return fmt::format("{:a},{:a},{:a},{:a},{:a},{:a}\n", b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z);
}

/// The unit is wrong: it never hits.
class NeverHits final : public BoxTest {
 public:
  explicit NeverHits(std::unique_ptr<BoxTest> unit) : unit_(std::move(unit)) {}
  void start(const ref::Ray& ray) override { unit_->start(ray); }
  bool hit(const ref::Aabb& box) override {
    static_cast<void>(unit_->hit(box));
    return false;
  }
  [[nodiscard]] std::span<const std::int64_t> operands() const override { return unit_->operands(); }
  [[nodiscard]] std::span<const std::int64_t> results() const override { return unit_->results(); }

 private:
  std::unique_ptr<BoxTest> unit_;
};

/// A file with one test: a number for each operand, the first of which may be another one.
std::string own_line(const rtl::Design& design, const std::string& number,
                     std::optional<std::string> first = {}) {
  std::vector<std::string> names;
  for (const rtl::Port& port : design.ports(design.default_format)) names.push_back(port.name);
  std::vector<std::string> numbers(names.size(), number);
  if (first) numbers.front() = *first;
  return fmt::format("{}\n{}\n", fmt::join(names, ","), fmt::join(numbers, ","));
}
std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class Operands : public testing::Test {
 protected:
  Operands() {
    std::string rays = "ox,oy,oz,dx,dy,dz,length\n";
    std::string boxes = "min_x,min_y,min_z,max_x,max_y,max_z\n";
    for (const Case& c : cases_) {
      rays += ray_line(c.ray);
      boxes += box_line(c.box);
    }
    options_.files = {folder_.write("r.csv", rays).string(), folder_.write("b.csv", boxes).string()};
  }

  [[nodiscard]] TestLayout layout(std::string_view design, TestForm form, bool with_input = false) const {
    const rtl::Design& of = rtl::find_design(design);
    return {of, of.default_format, options_.placement, form, with_input};
  }
  [[nodiscard]] static MakeBoxTest unit(std::string_view design) {
    const rtl::Design& of = rtl::find_design(design);
    return [&of] { return make_box_test(of, of.default_format); };
  }
  std::string written(std::string_view design, const TestLayout& how) {
    std::string text;
    counts_ = write_operands(unit(design), how, options_, [&](std::string_view part) { text += part; });
    return text;
  }

  const TemporaryFolder folder_;
  const std::vector<Case> cases_ = cases(5'000);
  OperandOptions options_;
  OperandCounts counts_;
};

constexpr std::int64_t nothing = -77;

/// The numbers of a line of CSV; patterns are hexadecimal.
std::vector<std::int64_t> numbers(const std::string& line) {
  std::vector<std::int64_t> all;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');)
    all.push_back(cell.empty() ? nothing : std::stoll(cell, nullptr, 0));
  return all;
}

TEST_F(Operands, AreThoseOfTheUnitWithHitAndTheExactAnswer) {
  for (const std::string_view design : {"int_slabs", "int_plucker", "fp_slabs", "fp_plucker", "int_major"}) {
    std::istringstream lines(written(design, layout(design, TestForm::csv)));
    const auto test = unit(design)();
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line.substr(0, 8), "ray,box,");
    OperandCounts counted;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      ASSERT_TRUE(std::getline(lines, line)) << i;
      test->start(cases_[i].ray);
      const bool hit = test->hit(cases_[i].box);
      const bool exact = ref::ray_meets_box_exact(cases_[i].ray, cases_[i].box);
      std::vector<std::int64_t> expected{static_cast<std::int64_t>(i + 1), static_cast<std::int64_t>(i + 1)};
      expected.insert(expected.end(), test->operands().begin(), test->operands().end());
      expected.push_back(hit ? 1 : 0);
      expected.push_back(exact ? 1 : 0);
      ASSERT_EQ(numbers(line), expected) << design << " line " << i;
      counted.hits += hit ? 1 : 0;
      counted.exact_hits += exact ? 1 : 0;
      counted.false_hits += hit && !exact ? 1 : 0;
      counted.false_misses += exact && !hit ? 1 : 0;
    }
    EXPECT_FALSE(std::getline(lines, line));
    EXPECT_EQ(counts_.tests, cases_.size());
    EXPECT_EQ(counts_.hits, counted.hits);
    EXPECT_EQ(counts_.exact_hits, counted.exact_hits);
    EXPECT_EQ(counts_.false_hits, counted.false_hits);
    EXPECT_EQ(counts_.false_misses, counted.false_misses);
  }
}

TEST_F(Operands, DoNotDependOnThreads) {
  for (const TestForm form : {TestForm::csv, TestForm::json, TestForm::hex}) {
    const TestLayout how = layout("int_slabs", form, true);
    options_.threads = 1;
    const std::string alone = written("int_slabs", how);
    options_.threads = 2;
    EXPECT_EQ(written("int_slabs", how), alone);
  }
}

/// More boxes than a part of the work has, and fewer.
TEST_F(Operands, EveryRayMeetsEveryBoxInOrder) {
  const std::string all_boxes = options_.files.boxes;
  const std::string some_rays =
      folder_.write("few.csv", "ox,oy,oz,dx,dy,dz\n0,0,0,1,1,1\n0.5,0,0,-1,0,0\n0,0,0,0,0,1\n").string();
  const std::string few_boxes =
      folder_.write("few_boxes.csv", "min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,1,1,1\n-1,-1,-1,0,0,0\n")
          .string();
  options_.threads = 2;
  const auto places = [&](const std::string& rays, const std::string& boxes, std::size_t count) {
    options_.files = {rays, boxes, true};
    std::istringstream lines(written("int_slabs", layout("int_slabs", TestForm::csv)));
    std::string line;
    std::getline(lines, line);
    for (std::int64_t test = 0; std::getline(lines, line); ++test) {
      const auto all = numbers(line);
      const auto width = static_cast<std::int64_t>(count);
      ASSERT_EQ(all[0], test / width + 1);
      ASSERT_EQ(all[1], test % width + 1);
    }
  };
  places(some_rays, all_boxes, cases_.size());
  EXPECT_EQ(counts_.tests, 3 * cases_.size());
  places(folder_.path() / "r.csv", few_boxes, 2);
  EXPECT_EQ(counts_.tests, 2 * cases_.size());
}

TEST_F(Operands, FalseMissesAreCountedAndTheFirstIsNamed) {
  std::size_t first = 0;
  while (!ref::ray_meets_box_exact(cases_[first].ray, cases_[first].box)) ++first;
  const MakeBoxTest wrong = [] { return std::make_unique<NeverHits>(unit("int_slabs")()); };
  options_.threads = 2;
  const OperandCounts counts =
      write_operands(wrong, layout("int_slabs", TestForm::csv), options_, [](std::string_view) {});
  EXPECT_GT(counts.exact_hits, 1000U);
  EXPECT_EQ(counts.false_misses, counts.exact_hits);
  ASSERT_TRUE(counts.false_miss);
  EXPECT_EQ(counts.false_miss->ray_line, first + 2);
  EXPECT_EQ(counts.false_miss->box_line, first + 2);
}

/// Children of one parent: their operands carry the interval of the parent, which is tested first.
TEST_F(Operands, TwoBoxesAreTestedAsChildrenOfOneParent) {
  std::string boxes =
      "min_x_0,min_y_0,min_z_0,max_x_0,max_y_0,max_z_0,min_x_1,min_y_1,min_z_1,max_x_1,max_y_1,max_z_1\n";
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    std::string line = box_line(cases_[i].box);
    line.back() = ',';
    boxes += line + box_line(cases_[(i + 27) % cases_.size()].box);
  }
  options_.files.boxes = folder_.write("pairs.csv", boxes).string();
  std::istringstream lines(written("int_major_pair", layout("int_major_pair", TestForm::csv)));
  const auto pair = unit("int_major_pair")();
  const auto single = unit("int_major")();
  std::string line;
  std::getline(lines, line);
  std::size_t parents = 0;
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    ASSERT_TRUE(std::getline(lines, line)) << i;
    const std::vector<std::int64_t> all = numbers(line);
    const ref::Aabb& first = cases_[i].box;
    const ref::Aabb& second = cases_[(i + 27) % cases_.size()].box;
    single->start(cases_[i].ray);
    pair->start(cases_[i].ray);
    static_cast<void>(pair->siblings(first, second));
    ASSERT_TRUE(std::equal(pair->operands().begin(), pair->operands().end(), all.begin() + 3));
    const std::size_t results = 3 + pair->operands().size();
    const std::array<bool, 2> hit{single->hit(first), single->hit(second)};
    hits += (hit[0] ? 1U : 0U) + (hit[1] ? 1U : 0U);
    const bool of_parent = all[2] == 1;
    parents += of_parent ? 1 : 0;
    if (of_parent) {
      ASSERT_FALSE(hit[0] || hit[1]) << i;
      // hit_0, hit_1, near_0, far_0, near_1, far_1, second_first
      for (const std::size_t of_second : {1U, 4U, 5U, 6U}) ASSERT_EQ(all[results + of_second], nothing) << i;
      for (const std::size_t of_first : {0U, 2U, 3U}) ASSERT_NE(all[results + of_first], nothing) << i;
    } else {
      ASSERT_EQ(all[results] != 0, hit[0]) << i;
      ASSERT_EQ(all[results + 1] != 0, hit[1]) << i;
    }
    ASSERT_EQ(all[all.size() - 2] != 0, ref::ray_meets_box_exact(cases_[i].ray, first)) << i;
    ASSERT_EQ(all[all.size() - 1] != 0, ref::ray_meets_box_exact(cases_[i].ray, second)) << i;
  }
  EXPECT_GT(parents, 100U);
  EXPECT_EQ(counts_.hits, hits);
  EXPECT_EQ(counts_.false_misses, 0U);
}

/// What the command wrote, and operands that no ray and box have.
TEST_F(Operands, OfOnesOwnGetTheUnitsResults) {
  for (const std::string_view name : {"int_slabs", "fp_slabs"}) {
    const rtl::Design& design = rtl::find_design(name);
    const std::string made = written(name, layout(name, TestForm::csv, true));
    const auto run = [&](const std::string& text, TestForm form) {
      std::string out;
      const RunCounts counts = run_operands(
          design, design.default_format, folder_.write("own.csv", text).string(), form,
          [&](std::string_view part) { out += part; }, [](double) {});
      EXPECT_GT(counts.tests, 0U);
      return out;
    };
    std::istringstream given(made);
    std::istringstream answered(run(made, TestForm::csv));
    std::string line;
    std::string own;
    std::getline(given, line);
    std::getline(answered, own);
    EXPECT_EQ(line,
              "ray,box,ox,oy,oz,dx,dy,dz,length,min_x,min_y,min_z,max_x,max_y,max_z," + own + ",exact_hit");
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      ASSERT_TRUE(std::getline(given, line) && std::getline(answered, own)) << i;
      // Behind ray, box and 13 numbers of the input; before the exact answer.
      std::size_t from = 0;
      for (int cell = 0; cell < 15; ++cell) from = line.find(',', from) + 1;
      ASSERT_EQ(own, line.substr(from, line.rfind(',') - from)) << i;
    }
    EXPECT_FALSE(std::getline(answered, own));
    EXPECT_EQ(lines_in(run(own_line(design, "0"), TestForm::hex)), 3U);
    EXPECT_THAT(run(own_line(design, "0x1"), TestForm::json), testing::HasSubstr("\"hit\":"));
    // The pattern of a negative number.
    const std::int64_t least = numbers_of(design.ports(design.default_format).front()).low;
    EXPECT_THAT(run(own_line(design, "0", least < 0 ? "0xfffff" : "0xffffffff"), TestForm::csv),
                testing::HasSubstr(least < 0 ? "\n-1,0," : "\n0xffffffff,0x00000000,"));
  }
}

TEST_F(Operands, OfOnesOwnThatDoNotFitRejected) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const auto told = [&](const std::string& text) {
    const std::string file = folder_.write("own.csv", text).string();
    const std::string line = message_of<std::runtime_error>([&] {
      run_operands(
          design, design.default_format, file, TestForm::csv, [](std::string_view) {}, [](double) {});
    });
    return line.substr(std::min(line.size(), file.size()));
  };
  const auto irx = [&](const std::string& word) { return told(own_line(design, "0", word)); };
  const std::string allowed =
      "\"; allowed is -524288 to 524287, or the pattern of its 20 bits, such as 0xfffff";
  for (const std::string word :
       {"524288", "-524289", "0x100000", "", "1.5", "x", "0x", "99999999999999999999"})
    EXPECT_EQ(irx(word), ": line 2: irx is \"" + word + allowed);
  EXPECT_THAT(irx(std::string(60'000, '1')), testing::EndsWith("1... (60000 bytes)" + allowed));
  for (const std::string word : {"524287", "-524288", "0xfffff"})
    EXPECT_THAT(irx(word), testing::Not(testing::HasSubstr("irx"))) << word;
  EXPECT_THAT(told("irx\n1\n"), testing::HasSubstr(": line 1: column \"iry\" is missing; "));
  EXPECT_EQ(told(own_line(design, "0").substr(0, own_line(design, "0").find('\n') + 1)),
            ": there is no line below the names of the columns");
}

/// The message has the beginning of the word.
TEST_F(Operands, LongWordsAreCutInMessages) {
  options_.files.rays = folder_.write("long.csv", std::string(60'000, 'x') + "\n").string();
  const std::string line =
      message_of<std::runtime_error>([&] { written("int_slabs", layout("int_slabs", TestForm::csv)); });
  EXPECT_THAT(
      line, testing::HasSubstr(": line 1: column \"" + std::string(50, 'x') + "... (60000 bytes)\" is not"));
  EXPECT_LT(line.size(), 400U);
}

TEST_F(Operands, TheFirstBadLineIsNamedOnAnyNumberOfThreads) {
  std::string rays = "ox,oy,oz,dx,dy,dz\n";
  for (int i = 0; i < 5'000; ++i) rays += i == 3'000 || i == 1'500 ? "2,0,0,1,0,0\n" : "0,0,0,1,0,0\n";
  options_.files.rays = folder_.write("bad.csv", rays + "one line too many\n").string();
  for (const int threads : {1, 2}) {
    options_.threads = threads;
    EXPECT_EQ(
        message_of<std::runtime_error>([&] { written("int_slabs", layout("int_slabs", TestForm::csv)); }),
        options_.files.rays +
            ": line 1502: ox 2 lies outside the cube; allowed is -1 to 1; for other units give the bounds of "
            "all boxes");
  }
}

TEST_F(Operands, FilesOfDifferentLengthRejected) {
  const std::string boxes = "min_x,min_y,min_z,max_x,max_y,max_z\n";
  const std::string more = options_.files.boxes;
  options_.files.rays = folder_.write("two.csv", "ox,oy,oz,dx,dy,dz\n0,0,0,1,0,0\n0,0,0,1,0,0\n").string();
  const auto told = [&] {
    return message_of<std::runtime_error>([&] { written("int_slabs", layout("int_slabs", TestForm::csv)); });
  };
  const std::string how = "; line i of the one file is tested with line i of the other, or all with all";
  EXPECT_EQ(told(), more + ": line 4: " + options_.files.rays + " has no line for it, only 2" + how);
  options_.files.boxes = folder_.write("one.csv", boxes + "0,0,0,1,1,1\n").string();
  EXPECT_EQ(told(),
            options_.files.rays + ": line 3: " + options_.files.boxes + " has no line for it, only 1" + how);
  options_.files.boxes = folder_.write("none.csv", boxes).string();
  options_.files.all_pairs = true;
  EXPECT_EQ(told(), options_.files.boxes + ": there is no line below the names of the columns");
}

}  // namespace
}  // namespace hitpipe::sim::operands_test
