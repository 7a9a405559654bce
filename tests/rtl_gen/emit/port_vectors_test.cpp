// The border search: pairs with different answers, one unit of one port apart, that meet the demands.
#include "rtl_gen/emit/port_vectors.hpp"

#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl::port_vectors_test {
namespace {

class BorderOf : public testing::TestWithParam<const char*> {
 protected:
  /// Calls visit(vectors) for each search that finds a border.
  template <class Visit>
  int search(const Demands& demands, Visit&& visit) const {
    const Draw draw(ports_, demands);
    const Border border(draw, evaluate_, results_);
    std::mt19937_64 random(11);
    DrawVectors walk(ports_, demands, evaluate_, 11);
    int found = 0;
    for (int i = 0; i < 200; ++i) {
      const std::vector<Vector> vectors = border.near(walk().operands, random);
      if (vectors.empty()) continue;
      ++found;
      visit(vectors);
    }
    return found;
  }
  [[nodiscard]] bool answers_differ(const Vector& a, const Vector& b) const {
    for (std::size_t i = 0; i < results_.size(); ++i)
      if (results_[i].width == 1 && a.results[i] != b.results[i]) return true;
    return false;
  }

  const Design& design_ = find_design(GetParam());
  const Format format_ = design_.default_format;
  const std::vector<Port> ports_ = design_.ports(format_);
  const std::vector<hls::Result> results_ = design_.results(format_);
  const Evaluate evaluate_ = design_.evaluate(format_);
};

TEST_P(BorderOf, GivesPairsOneUnitOfOnePortApart) {
  const int found = search({}, [&](const std::vector<Vector>& vectors) {
    ASSERT_GE(vectors.size(), 2U);
    EXPECT_TRUE(answers_differ(vectors[0], vectors[1]));
    for (const Vector& each : vectors)
      EXPECT_EQ(each.results, with_results(each.operands, evaluate_).results);
    int changed = 0;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      const std::int64_t step = vectors[0].operands[i] - vectors[1].operands[i];
      if (step == 0) continue;
      ++changed;
      const bool are_zeros = ports_[i].kind == hls::Kind::real && (step == 1LL << 31 || step == -(1LL << 31));
      EXPECT_TRUE(step == 1 || step == -1 || are_zeros) << ports_[i].name << ' ' << step;
    }
    EXPECT_EQ(changed, 1);
  });
  EXPECT_GT(found, 10);
}

INSTANTIATE_TEST_SUITE_P(Designs, BorderOf, testing::Values("int_slabs", "fp_slabs", "int_major_pair"));

using BorderOfIntSlabs = BorderOf;

TEST_P(BorderOfIntSlabs, StaysWithinTheDemands) {
  const Demands demands{{{"irx", {{-64, 64}}, 2}, {"rinf", {{0, 0}}}}, {{"ixmin", "ixmax"}}};
  const int found = search(demands, [&](const std::vector<Vector>& vectors) {
    for (const Vector& each : vectors) EXPECT_TRUE(meets(demands, ports_, each.operands.data()));
  });
  EXPECT_GT(found, 10);
}

INSTANTIATE_TEST_SUITE_P(Demands, BorderOfIntSlabs, testing::Values("int_slabs"));

}  // namespace
}  // namespace hitpipe::rtl::port_vectors_test
