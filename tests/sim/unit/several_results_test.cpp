// Verilog of a design with several results: all of them are read, and each one that is wrong is found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/emit/vectors.hpp"
#include "sim/check/check.hpp"
#include "sim/cosim/ray_unit.hpp"
#include "sim/software/feed.hpp"
#include "sim/software/software.hpp"
#include "sim/unit/drive.hpp"
#include "sim/unit/verilated_design.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/emit/two_boxes.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/unit/slabs_with_entry.hpp"

namespace hitpipe::sim::several_results_test {
namespace {

class SeveralResults : public testing::Test {
 protected:
  [[nodiscard]] VerilatedDesign built() const { return VerilatedDesign(unit); }
  void invert(const std::string& result) {
    const std::string assign = "assign " + result + " = ";
    const std::size_t at = unit.verilog.find(assign);
    ASSERT_NE(at, std::string::npos);
    const std::size_t from = at + assign.size();
    const std::size_t to = unit.verilog.find(';', from);
    unit.verilog.replace(from, to - from, "~(" + unit.verilog.substr(from, to - from) + ")");
  }

  const rtl::Design design = rtl::two_boxes();
  const Format format = design.default_format;
  rtl::Unit unit = rtl::make_unit(design, format, rtl::Library::thesis());
};

TEST_F(SeveralResults, AreThoseOfTheCpp) {
  for (const char* const bits : {"6/6", "9/11"}) {
    const Format at = design.parse_format(bits);
    const VerilatedDesign verilated(rtl::make_unit(design, at, rtl::Library::thesis()));
    ASSERT_EQ(verilated.results().size(), 3U);
    Model model(verilated);
    const std::vector<rtl::Vector> vectors =
        rtl::with_results(rtl::operand_vectors(design.ports(at), 20'000, 5), design.evaluate(at));
    std::vector<std::int64_t> results(3);
    std::size_t received = 0;
    std::size_t negative = 0;
    std::array<std::size_t, 2> hits{};
    for (std::size_t cycle = 0; received < vectors.size() && cycle < vectors.size() + 20; ++cycle) {
      const bool sending = cycle < vectors.size();
      Pins pins{.in_valid = sending, .results = results.data()};
      model.cycle(sending ? vectors[cycle].operands.data() : nullptr, pins);
      if (!pins.out_valid) continue;
      ASSERT_EQ(results, vectors[received].results) << received;
      ASSERT_EQ(pins.hit, results[1] != 0);
      negative += results[0] < 0 ? 1 : 0;
      for (std::size_t box = 0; box < 2; ++box) hits[box] += static_cast<std::size_t>(results[1 + box]);
      ++received;
    }
    EXPECT_EQ(received, vectors.size());
    EXPECT_GT(negative, received / 10);
    for (const std::size_t count : hits) {
      EXPECT_GT(count, received / 20);
      EXPECT_LT(count, received - received / 20);
    }
  }
}

VectorResult checked(const VerilatedDesign& verilated) {
  return check_vectors({.verilated = &verilated, .vectors = 2000});
}

TEST_F(SeveralResults, AgreeInAVectorCheck) {
  const VectorResult result = checked(built());
  EXPECT_EQ(result.mismatches, 0U) << result.first_mismatch;
  EXPECT_EQ(result.vectors, 2000U);
}

/// Boxes of the adversary at the ports of the first box, moved a little at the ports of the second.
class TwoBoxesTest final : public BoxTest {
 public:
  TwoBoxesTest(const rtl::Design& design, const Format& format, bool with_results)
      : evaluate_(design.evaluate(format)), with_results_(with_results) {}
  void start(const ref::Ray& ray) override {
    operands_[0] = grid(ray.origin.x);
    operands_[1] = grid(ray.direction.x);
    operands_[2] = 9;
  }
  bool hit(const ref::Aabb& box) override {
    operands_[3] = grid(box.min.x);
    operands_[4] = grid(box.max.x);
    operands_[5] = operands_[3] / 2;
    operands_[6] = operands_[4] / 2;
    evaluate_(operands_.data(), results_.data());
    return evaluate_.hit(results_.data());
  }
  [[nodiscard]] std::span<const std::int64_t> operands() const override { return operands_; }
  [[nodiscard]] std::span<const std::int64_t> results() const override {
    return with_results_ ? std::span<const std::int64_t>(results_) : std::span<const std::int64_t>();
  }

 private:
  static std::int64_t grid(float x) { return static_cast<std::int64_t>(std::clamp(x, -1.0F, 1.0F) * 15); }

  rtl::Evaluate evaluate_;
  bool with_results_;
  std::array<std::int64_t, 7> operands_{};
  std::array<std::int64_t, 3> results_{};
};

CategoryResult judged(const rtl::Design& design, const Format& format, const VerilatedDesign& verilated,
                      bool with_results = true) {
  return check([&] { return std::make_unique<TwoBoxesTest>(design, format, with_results); },
               {.categories = {ref::adversary::categories()[0]}, .tests = 3000, .rtl = &verilated})
      .front();
}

TEST_F(SeveralResults, AgreeInACheck) {
  EXPECT_EQ(judged(design, format, built()).rtl_mismatches, 0U);
}

TEST_F(SeveralResults, MustBeGivenByABoxTestThatTheVerilogAnswersToo) {
  EXPECT_THROW((void)judged(design, format, built(), false), std::invalid_argument);
}

class WrongResult : public SeveralResults, public testing::WithParamInterface<const char*> {};

TEST_P(WrongResult, IsFound) {
  invert(GetParam());
  const VerilatedDesign damaged = built();
  const VectorResult vectors = checked(damaged);
  EXPECT_EQ(vectors.mismatches, 2000U);
  EXPECT_THAT(vectors.first_mismatch, testing::ContainsRegex("^entry -?[0-9]+ hit_a [01] hit_b [01] tag 0, "
                                                             "expected entry -?[0-9]+ hit_a [01] hit_b [01] "
                                                             "tag 0 of vector 0 of seed 1: irx=0x"));
  EXPECT_EQ(judged(design, format, damaged).rtl_mismatches, 3000U);
}

INSTANTIATE_TEST_SUITE_P(Results, WrongResult, testing::Values("entry", "hit_a", "hit_b"));

/// The hills traced by a unit that gives HIT and a distance, compared with that C++.
UnitCounts traced(const rtl::Evaluate::Run cpp) {
  const rtl::Design design = rtl::design_of<hls::SlabsWithEntry>();
  const Format format = hls::IntBits{12, 12};
  const VerilatedDesign verilated(rtl::make_unit(design, format, rtl::Library::thesis()));
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const auto feed = make_feed(rtl::find_design("int_slabs"), format, bvh);
  RayUnit unit({.verilated = &verilated,
                .evaluate = {cpp, format, design.results(format)},
                .feed = feed.get(),
                .bvh = &bvh,
                .mesh = &scene.mesh,
                .rays_in_flight = 8,
                .referee = true});
  std::uint32_t given = 0;
  const auto next = [&]() -> std::optional<RayJob> {
    if (given == 500) return std::nullopt;
    const float along = static_cast<float>(given) / 500 - 0.5F;
    return RayJob{
        {{along, 0.9F, -along}, {along / 2, -1, 0.3F}, ref::Ray::infinite}, ref::Query::closest, given++};
  };
  unit.run(next, [](const RayJob&, const RayAnswer&) {});
  return unit.counts();
}

TEST(SeveralResultsOfOneBox, AreAllComparedWhileASceneIsTraced) {
  const rtl::Evaluate::Run right = rtl::detail::run_any<hls::SlabsWithEntry>;
  const UnitCounts same = traced(right);
  EXPECT_EQ(same.rtl_mismatches, 0U);
  EXPECT_EQ(same.false_misses, 0U);
  EXPECT_GT(same.hits, 500U);
  const rtl::Evaluate::Run other = [](const Format& format, const std::int64_t* operands, std::int64_t* out) {
    rtl::detail::run_any<hls::SlabsWithEntry>(format, operands, out);
    out[1] ^= 1;
  };
  const UnitCounts differing = traced(other);
  EXPECT_EQ(differing.rtl_mismatches, same.box_tests);
  EXPECT_EQ(differing.hits, same.hits);
}

TEST_F(SeveralResults, OfTwoBoxesTraceNoSceneWithAFeedForOne) {
  Software software;
  software.feed = software_of(rtl::find_design("int_slabs")).feed;
  add_software(design.name, software);
  EXPECT_EQ(why_not_traced(design), "");
  const ref::Bvh bvh = ref::build_bvh(hills().mesh);
  EXPECT_EQ(message_of<std::runtime_error>([&] {
              static_cast<void>(make_feed(design, hls::IntBits{12, 12}, bvh));
            }),
            "design two_boxes: answers for 2 boxes at a time, and its feed is for one");
}

TEST(AddDesign, RefusesANameThatIsTakenAndAddsNothing) {
  const rtl::Design taken = rtl::designs().front();
  const std::size_t before = rtl::designs().size();
  EXPECT_EQ(message_of<std::invalid_argument>([&] { add_design(taken, {}); }),
            "design " + std::string(taken.name) + ": its software is known already");
  EXPECT_EQ(rtl::designs().size(), before);
}

}  // namespace
}  // namespace hitpipe::sim::several_results_test
