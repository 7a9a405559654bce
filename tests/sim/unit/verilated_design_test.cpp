// The emitted Verilog of every design equals the C++ datapath bit by bit: with the adversary's rays and
// boxes, operands at their corners and random operands, at full speed and with gaps, stalls and resets.
// Answers keep their order and tags, wait until they are taken, and do not survive a reset.
#include <array>

#include <gtest/gtest.h>

#include "rtl_gen/emit/vectors.hpp"
#include "sim/vectors/design_vectors.hpp"
#include "tests/sim/adversary_vectors.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/testbench.hpp"

namespace hitpipe::sim::verilated_design_test {
namespace {

constexpr std::array<Traffic, 6> traffics{{{"full", 1.0, 1.0},
                                           {"gaps", 0.6, 1.0},
                                           {"stalls", 1.0, 0.6},
                                           {"gaps and stalls", 0.7, 0.7},
                                           {"resets", 1.0, 0.9, 0.002},
                                           {"long stalls", 0.9, 0.25}}};
constexpr std::uint64_t first_seed = 20050;

// DESIGN 7: a million vectors for the units of the thesis's tables.
constexpr int categories = 27;
constexpr int vectors_per_category = 34'000;
constexpr int raw_vectors = 50'000;
constexpr int random_vectors = 50'000;
static_assert(categories * vectors_per_category + raw_vectors + random_vectors >= 1'000'000);
constexpr int share_of_other_units = 20;

using Vectors = std::vector<std::vector<std::int64_t>>;

class VerilatedUnit : public testing::TestWithParam<TestedUnit> {
 protected:
  /// Runs the vectors in batches of different traffic and returns the results.
  DriveReport run(const std::string& name, const Vectors& vectors, std::uint64_t seed) {
    DriveReport all;
    const std::size_t batch = (vectors.size() + traffics.size() - 1) / traffics.size();
    for (std::size_t i = 0; i < traffics.size(); ++i) {
      const auto from = vectors.begin() + static_cast<std::ptrdiff_t>(std::min(i * batch, vectors.size()));
      const auto to =
          vectors.begin() + static_cast<std::ptrdiff_t>(std::min((i + 1) * batch, vectors.size()));
      all += sent(Vectors(from, to), traffics[i], seed + i, seed);
    }
    std::printf("%9llu %9llu %9llu %7llu  %s\n", static_cast<unsigned long long>(all.received),
                static_cast<unsigned long long>(all.hits), static_cast<unsigned long long>(all.stalls),
                static_cast<unsigned long long>(all.resets), name.c_str());
    EXPECT_TRUE(all.clean()) << name << ": " << all.first_failure;
    EXPECT_EQ(all.wrong_results + all.wrong_tags + all.not_held + all.lost + all.surplus, 0U) << name;
    EXPECT_EQ(all.sent, vectors.size()) << name;
    EXPECT_EQ(all.received, vectors.size()) << name;
    EXPECT_GT(all.stalls, vectors.size() / 4) << name;
    return all;
  }
  DriveReport sent(const Vectors& vectors, const Traffic& traffic, std::uint64_t seed = first_seed,
                   std::uint64_t vector_seed = first_seed) {
    return drive_all(model_, vectors, traffic, seed, vector_seed);
  }
  [[nodiscard]] int count(int of_the_thesis) const {
    return GetParam().of_the_thesis() ? of_the_thesis : of_the_thesis / share_of_other_units;
  }
  static void print_head() {
    std::printf("seed %llu\n%9s %9s %9s %7s  vectors\n", static_cast<unsigned long long>(first_seed),
                "received", "hits", "stalls", "resets");
  }

  const VerilatedDesign& design_ = verilated(GetParam());
  const std::vector<rtl::Port> ports_ = GetParam().ports();
  Model model_{design_};
};

TEST_P(VerilatedUnit, AgreesOnTheAdversary) {
  if (!GetParam().design().kind.of_boxes) GTEST_SKIP() << "it tests no boxes";
  print_head();
  DriveReport all;
  std::uint64_t seed = first_seed;
  const auto size = static_cast<std::uint64_t>(count(vectors_per_category));
  for (const auto& category : ref::adversary::categories()) {
    const Vectors vectors = adversary_vectors(GetParam(), category, static_cast<int>(size), seed += 100);
    const DriveReport report = run(std::string(category.name), vectors, seed);
    EXPECT_GT(report.hits, size / 50) << category.name;
    all += report;
  }
  EXPECT_EQ(all.received, categories * size);
  EXPECT_LT(all.hits, all.received - all.received / 8);
  EXPECT_GT(all.resets, categories * size / 10'000);
  EXPECT_GT(all.dropped, all.resets);
}

TEST_P(VerilatedUnit, AgreesOnCornersChosenAndRandomOperands) {
  print_head();
  const int raw = count(raw_vectors);
  const int any = count(random_vectors);
  const DriveReport corners = run("raw corners", raw_corner_vectors(GetParam(), raw, first_seed), first_seed);
  EXPECT_EQ(corners.received, static_cast<std::uint64_t>(raw));
  // These show every planted fault that can show (planted_faults_test.cpp).
  const auto vectors =
      design_vectors(GetParam().design(), GetParam().format, usual_vectors, usual_seed).all();
  Vectors chosen;
  for (const rtl::Vector& vector : vectors) chosen.push_back(vector.operands);
  EXPECT_EQ(run("vectors of the design", chosen, usual_seed).received,
            static_cast<std::uint64_t>(usual_vectors));
  const DriveReport random = run("random", rtl::operand_vectors(ports_, any, first_seed), first_seed + 100);
  EXPECT_EQ(random.received, static_cast<std::uint64_t>(any));
  for (const DriveReport& report : {corners, random}) {
    EXPECT_GT(report.hits, report.received / 200);
    EXPECT_LT(report.hits, report.received - report.received / 200);
  }
}

TEST_P(VerilatedUnit, ResetEmptiesThePipeline) {
  const auto vectors = rtl::operand_vectors(ports_, 100, first_seed);
  const int depth = design_.latency() + 1;  // tests that fit
  std::uint16_t tag = 0;
  for (int taken = 1; taken <= depth; ++taken) {
    for (const bool stalled : {false, true}) {
      for (int i = 0; i < taken; ++i) {
        Pins pins{.in_valid = true, .out_ready = !stalled, .in_tag = tag};
        model_.cycle(vectors[tag % vectors.size()].data(), pins);
        ASSERT_TRUE(pins.in_ready);
        ASSERT_FALSE(pins.out_valid);
        ++tag;
      }
      for (int i = 0; stalled && i < depth; ++i) {
        Pins pins{.out_ready = false};
        model_.cycle(nullptr, pins);  // the oldest answer comes out and waits
      }
      Pins reset{.rst = true, .out_ready = !stalled};
      model_.cycle(nullptr, reset);
      for (int i = 0; i < 3 * depth; ++i) {
        Pins pins;
        model_.cycle(nullptr, pins);
        EXPECT_FALSE(pins.out_valid) << taken << " tests in flight, " << i << " cycles after reset";
      }
      const DriveReport report = sent(vectors, traffics[3]);
      EXPECT_TRUE(report.clean()) << report.first_failure;
      EXPECT_EQ(report.received, vectors.size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Units, VerilatedUnit, testing::ValuesIn(units()),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST(VerilatedDesignModel, StandsStillWhileItsAnswerIsNotTaken) {
  const hls::IntBits bits{20, 24};
  Model model(verilated(bits));
  const auto vectors = rtl::operand_vectors(int_slabs().ports(bits), 100, first_seed);
  // Tests are offered without end and answers never taken: the pipeline fills, then takes no more.
  std::size_t taken = 0;
  for (int cycle = 0; cycle < 50; ++cycle) {
    Pins pins{.in_valid = true, .out_ready = false, .in_tag = static_cast<std::uint16_t>(taken)};
    model.cycle(vectors[taken].data(), pins);
    taken += pins.in_ready ? 1 : 0;
  }
  EXPECT_EQ(taken, static_cast<std::size_t>(verilated(bits).latency()) + 1);
  for (std::size_t i = 0; i < taken; ++i) {
    Pins pins;
    model.cycle(nullptr, pins);
    ASSERT_TRUE(pins.out_valid);
    EXPECT_EQ(pins.out_tag, i);
    EXPECT_EQ(pins.hit, int_slabs().evaluate(bits)(vectors[i].data()));
  }
  Pins pins;
  model.cycle(nullptr, pins);
  EXPECT_FALSE(pins.out_valid);
}

TEST(VerilatedDesignModel, InstancesDoNotShareState) {
  const hls::IntBits bits{20, 24};
  const std::vector<rtl::Port> ports = int_slabs().ports(bits);
  const auto vectors = rtl::operand_vectors(ports, 1000, first_seed);
  Model one(verilated(bits));
  Model other(verilated(bits));
  Pins pins{.in_valid = true, .out_ready = false, .in_tag = 7};
  one.cycle(vectors[0].data(), pins);  // one test in flight in one of them
  EXPECT_TRUE(drive_all(other, vectors, traffics[3], first_seed, first_seed).clean());
  int answers = 0;
  for (int i = 0; i < 20; ++i) {
    Pins wait;
    one.cycle(nullptr, wait);
    answers += wait.out_valid ? 1 : 0;
    if (wait.out_valid) {
      EXPECT_EQ(wait.out_tag, 7);
    }
  }
  EXPECT_EQ(answers, 1);
}

TEST(VerilatedDesignModel, OutlivesItsDesignAndMoves) {
  const hls::IntBits bits{20, 24};
  const std::vector<rtl::Port> ports = int_slabs().ports(bits);
  const auto vectors = rtl::operand_vectors(ports, 1000, first_seed);
  auto design = std::make_unique<VerilatedDesign>(rtl::make_unit(int_slabs(), bits, rtl::Library::thesis()));
  Model first(*design);
  design.reset();
  Model second(std::move(first));
  EXPECT_TRUE(drive_all(second, vectors, traffics[0], first_seed, first_seed).clean());
}

}  // namespace
}  // namespace hitpipe::sim::verilated_design_test
