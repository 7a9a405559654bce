// Vectors through a fitted unit's Verilog: all agree with the C++, half of them are hits, and faults of the
// Verilog are found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/fit/fit.hpp"
#include "sim/unit/drive.hpp"
#include "tests/sim/units.hpp"
#include "tests/sw_ref/quantise/demand_scenes.hpp"

namespace hitpipe::sim::vector_check_test {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t vectors = 20'000;

/// int_slabs for the flat hills, where axis y is narrow.
class Vectors : public testing::Test {
 protected:
  [[nodiscard]] VectorResult sent(std::uint64_t count = vectors, std::uint64_t seed = 1) const {
    const VerilatedDesign verilated(unit_);
    return check_vectors({.verilated = &verilated, .vectors = count, .seed = seed});
  }

 private:
  static rtl::Unit made() {
    const ref::Scene scene = ref::flat_hills();
    const ref::Bvh bvh = ref::build_bvh(scene.mesh);
    return fit(rtl::find_design("int_slabs"), hls::IntBits{12, 12}, std::nullopt,
               ref::scene_demands(scene, bvh, {}), rtl::Library::thesis());
  }

 protected:
  rtl::Unit unit_ = made();
};

TEST_F(Vectors, AgreeAndHalfOfThemHit) {
  ASSERT_FALSE(unit_.demands.empty());
  const VectorResult result = sent();
  EXPECT_EQ(result.vectors, vectors);
  EXPECT_EQ(result.mismatches, 0U) << result.first_mismatch;
  EXPECT_GT(result.hits, vectors * 3 / 10);
  EXPECT_LT(result.hits, vectors * 7 / 10);
  std::cout << result.vectors << " vectors of seed 1, " << result.hits << " hits\n";
}

TEST_F(Vectors, ComeFromTheSeedAlone) {
  EXPECT_EQ(sent(1000, 7).hits, sent(1000, 7).hits);
  EXPECT_NE(sent(1000, 7).hits, sent(1000, 8).hits);
}

TEST_F(Vectors, NoneAskedForNoneSent) {
  const VectorResult result = sent(0);
  EXPECT_EQ(result.vectors, 0U);
  EXPECT_EQ(result.mismatches, 0U);
}

TEST_F(Vectors, FindAnotherTestsTag) {
  unit_ = damaged(unit_, "tag_s1 <= tag_s0", "tag_s1 <= in_tag");
  const VectorResult result = sent(1000);
  EXPECT_EQ(result.vectors, 1000U);
  EXPECT_GT(result.mismatches, 0U);
  EXPECT_THAT(result.first_mismatch, HasSubstr(" of seed 1: irx=0x"));
}

TEST_F(Vectors, FindLostTests) {
  unit_ = damaged(unit_, "else if (advance) valid", "else if (advance & ~valid[0]) valid");
  const VectorResult result = sent(1000);
  EXPECT_GT(result.mismatches, 0U);
  EXPECT_NE(result.first_mismatch, "");
}

}  // namespace
}  // namespace hitpipe::sim::vector_check_test
