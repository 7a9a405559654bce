// The divider against division of 128-bit integers: every test that it takes is answered once, in order, with
// the right T and the right comparison, at any rate and in any format.
#include "hls/machines/divider.hpp"

#include <deque>
#include <random>

#include <gtest/gtest.h>

#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl::divider_test {
namespace {

struct Found {
  unsigned ray;
  Number det, num;
  Word t;
};

/// Numbers as int_triangle gives them for hits: T fits its bits.
class Tests {
 public:
  Tests(const hls::CoreBits& bits, unsigned seed) : bits_(bits), random_(seed) {}

  Found next(unsigned ray) {
    const Word det = between(1, ones_below(bits_.determinant() - 1));
    const int shift = bits_.slope + bits_.fraction;
    // |num| 2^(S+F) < 2^Q |det|
    const int q = bits_.distance();
    Word most = q >= shift ? (det << (q - shift)) - 1 : (det - 1) >> (shift - q);
    most = std::min(most, ones_below(bits_.volume() - 1));
    Word num = between(0, most);
    // |num| 2^(S+F) is often a multiple of |det|, or one less than a multiple.
    if (random_() % 4 == 0 && most > det) num = num / det * det - random_() % 2;
    num = std::min(num, most);
    const bool back = random_() % 2 != 0, turned = random_() % 2 != 0;
    return {ray, back ? -static_cast<Number>(det) : static_cast<Number>(det),
            turned ? -static_cast<Number>(num) : static_cast<Number>(num), (num << shift) / det};
  }

 private:
  /// Of all sizes, and often an end.
  Word between(Word least, Word most) {
    switch (random_() % 8) {
      case 0:
        return least;
      case 1:
        return most;
      default: {
        const Word word = (Word{random_()} << 64 | random_()) >> random_() % 120;
        return std::clamp(word & ones_below(width_of_bits(most)), least, most);
      }
    }
  }

  hls::CoreBits bits_;
  std::mt19937_64 random_;
};

struct Ray {
  Word number, best, best_number;
  bool waits = false;
};

class DividerIn : public testing::TestWithParam<hls::CoreBits> {};

TEST_P(DividerIn, GivesTheFloorAndTheNearest) {
  const hls::CoreBits bits = GetParam();
  const auto machine = machine_called("divider")->native(bits);
  Tests tests(bits, 7);
  std::mt19937_64 random(8);
  std::vector<Ray> rays(static_cast<std::size_t>(bits.rays()));
  std::deque<Found> sent;
  Word asked = 0;
  int answers = 0, closer_ones = 0, equal_ones = 0, longest = 0, since = 0;
  // det and num by their halves
  const auto high = [](Number x, int width) {
    return static_cast<Word>(x >> (width / 2)) & ones_below(width - width / 2);
  };
  const auto low = [](Number x, int width) { return static_cast<Word>(x) & ones_below(width / 2); };
  for (int cycle = 0; cycle < 1'000'000; ++cycle) {
    const unsigned ray = static_cast<unsigned>(random() % rays.size());
    const bool crowded = cycle / 10'000 % 2 == 0;
    const bool sends = !rays[ray].waits && (crowded || random() % 16 == 0);
    Found test{};
    if (sends) {
      test = tests.next(ray);
      // Often the best is what this test finds, so the numbers decide.
      const Word best = random() % 3 == 0 ? test.t : random() & ones_below(bits.distance());
      rays[ray] = {.number = random() & ones_below(32), .best = best, .best_number = 0, .waits = true};
      rays[ray].best_number = random() % 4 == 0 ? ones_below(32) : rays[ray].number + random() % 3 - 1;
      rays[ray].best_number &= ones_below(32);
      sent.push_back(test);
    }
    const Ray& wanted = rays[static_cast<std::size_t>(asked)];
    const Word in[] = {sends,
                       sends || random() % 2 != 0,
                       ray,
                       high(test.det, bits.determinant()),
                       low(test.det, bits.determinant()),
                       high(test.num, bits.volume()),
                       low(test.num, bits.volume()),
                       wanted.number,
                       wanted.best,
                       wanted.best_number};
    Word out[4];
    machine->outputs(out);
    machine->step(in, cycle == 0);
    if (cycle == 0) {
      sent.clear();
      for (Ray& each : rays) each.waits = false;
      continue;
    }
    since = sent.empty() ? 0 : since + 1;
    if (out[1] != 0) {
      ASSERT_FALSE(sent.empty()) << "cycle " << cycle;
      const Found expected = sent.front();
      sent.pop_front();
      Ray& owner = rays[expected.ray];
      const bool closer =
          expected.t < owner.best || (expected.t == owner.best && owner.number < owner.best_number);
      ASSERT_EQ(out[0], expected.ray) << "cycle " << cycle;
      ASSERT_TRUE(out[2] == expected.t) << "cycle " << cycle << ": T " << static_cast<std::uint64_t>(out[2])
                                        << ", expected " << static_cast<std::uint64_t>(expected.t);
      ASSERT_EQ(out[3] != 0, closer) << "cycle " << cycle;
      owner.waits = false;
      ++answers;
      closer_ones += closer ? 1 : 0;
      equal_ones += expected.t == owner.best ? 1 : 0;
      longest = std::max(longest, since);
      since = 0;
    }
    asked = out[0];
  }
  EXPECT_LE(sent.size(), rays.size());
  EXPECT_GE(answers, 500'000 / hls::divider::interval(bits)) << "half of the time the queue is full";
  EXPECT_GT(closer_ones, answers / 8);
  EXPECT_GT(equal_ones, answers / 8);
  EXPECT_TRUE(bits.distance() > 24 || hls::divider::interval(bits) <= 14);
  EXPECT_LE(longest, hls::divider::interval(bits) + 3) << "of a test that does not wait for others";
}

INSTANTIATE_TEST_SUITE_P(
    Formats, DividerIn,
    testing::Values(hls::CoreBits{}, hls::CoreBits{{20, 1, 20, 0, 0}, 7}, hls::CoreBits{{20, 1, 20, 4, 0}, 3},
                    hls::CoreBits{{16, 1, 16, 0, 0}, 5}, hls::CoreBits{{24, 3, 32, 8, 0}, 8},
                    hls::CoreBits{{24, 3, 8, 0, 0}, 1}, hls::CoreBits{{24, 0, 12, 8, 0}, 4},
                    hls::CoreBits{{8, 0, 8, 0, 0}, 2}),
    [](const testing::TestParamInfo<hls::CoreBits>& each) { return Format(each.param).identifier(); });

TEST(Divider, TakesATestEveryIntervalOfCycles) {
  // 20+1: 10 cycles of division, one that loads, and one that compares.
  EXPECT_EQ(hls::divider::interval(hls::CoreBits{}), 12);
  EXPECT_EQ(hls::divider::interval(hls::WorldBits{20, 1, 20, 4, 0}), 14);
  EXPECT_EQ(hls::divider::interval(hls::WorldBits{24, 1, 24, 0, 0}), 14);
  // The longest T of any format has 34 bits.
  EXPECT_EQ(hls::divider::interval(hls::WorldBits{24, 3, 32, 8, 0}), 19);
}

}  // namespace
}  // namespace hitpipe::rtl::divider_test
