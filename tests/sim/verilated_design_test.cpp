// The emitted Verilog is the C++ datapath, bit by bit: named corners, then random operands, at full speed and
// with gaps and stalls. Answers keep their order and tags, wait while they are not taken, and do not outlive
// a reset.
#include <array>

#include <gtest/gtest.h>

#include "rtl_gen/emit/testbench.hpp"
#include "tests/sim/corner_vectors.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/testbench.hpp"

namespace hitpipe::sim {
namespace {

constexpr std::array<Traffic, 5> traffics{{{"full", 1.0, 1.0},
                                           {"gaps", 0.6, 1.0},
                                           {"stalls", 1.0, 0.5},
                                           {"gaps and stalls", 0.7, 0.7},
                                           {"long stalls", 0.9, 0.15}}};
constexpr std::uint64_t first_seed = 20050;

class VerilatedDesignFormat : public testing::TestWithParam<hls::IntBits> {
 protected:
  const VerilatedDesign& design_ = verilated(GetParam());
  const std::vector<rtl::Port> ports_ = rtl::input_ports(int_slabs().trace(GetParam()));
  const rtl::Evaluate evaluate_ = int_slabs().evaluate(GetParam());
  Model model_{design_};
};

TEST_P(VerilatedDesignFormat, AgreesOnNamedCorners) {
  const std::vector<CornerVector> corners = corner_vectors(ports_);
  EXPECT_EQ(corners.size(), 52U);
  for (const CornerVector& corner : corners) {
    const TestbenchReport report =
        drive(model_, ports_, evaluate_, {corner.operands}, traffics[0], first_seed, 0);
    EXPECT_TRUE(report.clean()) << corner.name << ": " << report.first_failure;
    EXPECT_EQ(report.received, 1U) << corner.name;
  }
}

TEST_P(VerilatedDesignFormat, AgreesOnRandomVectorsWithGapsAndStalls) {
  // DESIGN 7: a million vectors for the formats of the thesis's tables.
  const bool of_the_thesis = GetParam() == hls::IntBits{24, 24} || GetParam() == hls::IntBits{20, 24};
  constexpr int batch = 10'000;
  const int batches = of_the_thesis ? 100 : 20;
  TestbenchReport all;
  for (int i = 0; i < batches; ++i) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
    const auto vectors = rtl::operand_vectors(ports_, batch, seed);
    all += drive(model_, ports_, evaluate_, vectors, traffics[static_cast<std::size_t>(i) % traffics.size()],
                 seed, seed);
  }
  std::printf("%llu vectors from seed %llu on, %llu hits, %llu stalled cycles\n",
              static_cast<unsigned long long>(all.received), static_cast<unsigned long long>(first_seed),
              static_cast<unsigned long long>(all.hits), static_cast<unsigned long long>(all.stalls));
  const auto intended = static_cast<std::uint64_t>(batch) * static_cast<std::uint64_t>(batches);
  EXPECT_TRUE(all.clean()) << all.first_failure;
  EXPECT_EQ(all.wrong_hits, 0U);
  EXPECT_EQ(all.wrong_tags, 0U);
  EXPECT_EQ(all.not_held, 0U);
  EXPECT_EQ(all.lost, 0U);
  EXPECT_EQ(all.surplus, 0U);
  EXPECT_EQ(all.sent, intended);
  EXPECT_EQ(all.received, intended);
  // Neither answer is rare, and stalls were there.
  EXPECT_GT(all.hits, intended / 50);
  EXPECT_LT(all.hits, intended - intended / 50);
  EXPECT_GT(all.stalls, intended);
}

TEST_P(VerilatedDesignFormat, ResetEmptiesThePipeline) {
  const auto vectors = rtl::operand_vectors(ports_, 200, first_seed);
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
      const TestbenchReport report =
          drive(model_, ports_, evaluate_, vectors, traffics[3], first_seed, first_seed);
      EXPECT_TRUE(report.clean()) << report.first_failure;
      EXPECT_EQ(report.received, vectors.size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, VerilatedDesignFormat, testing::ValuesIn(formats),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST(VerilatedDesignModel, StandsStillWhileItsAnswerIsNotTaken) {
  const hls::IntBits bits{20, 24};
  Model model(verilated(bits));
  const auto vectors = rtl::operand_vectors(rtl::input_ports(int_slabs().trace(bits)), 100, first_seed);
  // Offered without end and never taken: it fills, then takes no more.
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
  const std::vector<rtl::Port> ports = rtl::input_ports(int_slabs().trace(bits));
  const auto vectors = rtl::operand_vectors(ports, 1000, first_seed);
  Model one(verilated(bits));
  Model other(verilated(bits));
  Pins pins{.in_valid = true, .out_ready = false, .in_tag = 7};
  one.cycle(vectors[0].data(), pins);  // one test in flight in one of them
  EXPECT_TRUE(
      drive(other, ports, int_slabs().evaluate(bits), vectors, traffics[3], first_seed, first_seed).clean());
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
  const std::vector<rtl::Port> ports = rtl::input_ports(int_slabs().trace(bits));
  const auto vectors = rtl::operand_vectors(ports, 1000, first_seed);
  auto design = std::make_unique<VerilatedDesign>(int_slabs(), bits, rtl::Library::thesis());
  Model first(*design);
  design.reset();
  Model second(std::move(first));
  EXPECT_TRUE(
      drive(second, ports, int_slabs().evaluate(bits), vectors, traffics[0], first_seed, first_seed).clean());
}

}  // namespace
}  // namespace hitpipe::sim
