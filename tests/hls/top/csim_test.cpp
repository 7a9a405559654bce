// The comparison of a top function with its pipeline, on a design with two results.
#include "hls/top/csim.hpp"

#include <random>

#include <gtest/gtest.h>

#include "hls/box/format_list.hpp"
#include "hls/box/fp_slabs_operands.hpp"
#include "hls/box/int_format.hpp"
#include "hls/box/int_slabs_operands.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe::hls {
namespace {

constexpr std::uint64_t seed = 92;
using Format = IntFormat<12, 16>;

template <class D, class F>
struct DepthOperands {
  typename F::template Coord<D> low, high;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(format.plane("low", Role::plane_low, Axis::x), self.low);
    visit(format.plane("high", Role::plane_high, Axis::x), self.high);
  }
};

template <class D, class F>
struct DepthResults {
  typename F::template Coord<D> entry;
  typename D::bit hit;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(Result{"entry", Meaning::entry, 0, format.coord, true}, self.entry);
    visit(Result{"hit", Meaning::hit, 0, 1, false}, self.hit);
  }
};

/// The lower plane as a distance, and whether the higher one lies ahead.
struct Depth {
  static constexpr const char* name = "depth";
  template <class D, class F>
  using Operands = DepthOperands<D, F>;
  template <class D, class F>
  using Results = DepthResults<D, F>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& /*format*/, const DepthOperands<D, F>& in) {
    using Bit = typename D::bit;
    return {in.low, Bit(~Bit(sign(in.high)))};
  }
};

void answers(top::Integer<12> low, top::Integer<12> high, top::Integer<12>& entry, top::Bit& hit) {
  entry = low;
  hit = high >= 0;
}
void answers_hit_alone(top::Integer<12> /*low*/, top::Integer<12> high, top::Integer<12>& /*entry*/,
                       top::Bit& hit) {
  hit = high >= 0;
}
void answers_entry_alone(top::Integer<12> low, top::Integer<12> /*high*/, top::Integer<12>& entry,
                         top::Bit& /*hit*/) {
  entry = low;
}
void answers_wrong_once(top::Integer<12> low, top::Integer<12> high, top::Integer<12>& entry, top::Bit& hit) {
  static int calls = 0;
  answers(low, high, entry, hit);
  if (++calls == 50) entry = low + 1;
}

TEST(Comparison, AcceptsRightAnswers) {
  const top::Comparison result = top::compare<Depth, Format>(answers, 1000, seed);
  EXPECT_EQ(result.mismatches, 0);
  EXPECT_EQ(result.tests, 1000);
  EXPECT_GT(result.hits, 100);
  EXPECT_LT(result.hits, 900);
}

TEST(Comparison, CountsEveryResultThatIsNotWritten) {
  EXPECT_EQ((top::compare<Depth, Format>(answers_hit_alone, 100, seed).mismatches), 100);
  EXPECT_EQ((top::compare<Depth, Format>(answers_entry_alone, 100, seed).mismatches), 100);
}

TEST(Comparison, CountsAWrongDistance) {
  EXPECT_EQ((top::compare<Depth, Format>(answers_wrong_once, 100, seed).mismatches), 1);
}

TEST(Csim, TellsRightFromWrong) {
  EXPECT_EQ((top::csim<Depth, Format>(answers)), 0);
  EXPECT_EQ((top::csim<Depth, Format>(answers_hit_alone)), 1);
}

/// A design of which the operands alone matter.
template <template <class, class> class In>
struct OperandsOf {
  template <class D, class F>
  using Operands = In<D, F>;
};

TEST(RandomOperands, AreAsTheDesignStatesThem) {
  std::mt19937_64 random(seed);
  int in_order = 0, out_of_order = 0, draws = 0;
  for (; draws < 4000; ++draws) {
    const auto words = top::random_operands<OperandsOf<IntSlabsOperands>, Format>(random);
    ASSERT_EQ(words.size(), 17U);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const top::OperandWord& operand = words[i];
      if (operand.port.role == Role::length) {
        EXPECT_EQ(operand.word >> (operand.port.width - 1) & 1, 0U);
      }
      if (operand.port.role == Role::plane_high)
        ++(top::is_below(operand, words[i - 1]) ? out_of_order : in_order);
    }
  }
  // Any bits, one draw in eight: half of those slabs are out of order.
  EXPECT_NEAR(out_of_order, 3 * draws / 16, 3 * draws / 64);
  EXPECT_EQ(in_order + out_of_order, 3 * draws);
}

TEST(RandomOperands, FloatsAreOfAnyFormat) {
  std::mt19937_64 random(seed);
  int ordinary = 0;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    const auto words = top::random_operands<OperandsOf<FpSlabsOperands>, FpFormat<5, 10>>(random);
    // 2^-8 to 2 in binary16 has the exponents 7 to 15.
    const auto is_ordinary = [](const top::OperandWord& x) {
      const std::uint64_t exponent = x.word >> 10 & 31;
      return x.port.kind == Kind::flag || (exponent >= 7 && exponent <= 15);
    };
    ordinary += std::all_of(words.begin(), words.end(), is_ordinary) ? 1 : 0;
  }
  EXPECT_NEAR(ordinary, draws * 7 / 8, draws / 32);
}

TEST(RandomOperands, FloatsAreOrderedByTheirNumbers) {
  const Operand port = real_operand("x", Role::other, Axis::none, 32);
  const auto below = [&](std::uint64_t a, std::uint64_t b) { return top::is_below({port, a}, {port, b}); };
  EXPECT_TRUE(below(0x3f800000, 0x40000000));  // 1 and 2
  EXPECT_FALSE(below(0x40000000, 0x3f800000));
  EXPECT_TRUE(below(0xc0000000, 0xbf800000));  // -2 and -1
  EXPECT_FALSE(below(0xbf800000, 0xc0000000));
  EXPECT_TRUE(below(0xbf800000, 0x3f800000));  // -1 and 1
}

}  // namespace
}  // namespace hitpipe::hls
