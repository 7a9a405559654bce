// Adaptive slabs: a sure answer is the exact one, and more bits leave fewer tests open.
#include "thesis/adaptive_slabs.hpp"

#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::thesis::adaptive_slabs_test {
namespace {

struct Answers {
  int tests = 0;
  int asked = 0;
  int sure_hits = 0;
  int wrong = 0;
};

Answers judged(const adversary::Category& category, hls::IntBits bits, int rays) {
  adversary::Random random(7);
  Answers answers;
  std::vector<Aabb> boxes(16);
  for (int ray = 0; ray < rays; ++ray) {
    const adversary::Case c = category.make(random);
    adversary::neighbours(random, c.box, boxes);
    const AdaptiveSlabs unit(c.ray, bits);
    for (const Aabb& box : boxes) {
      const Answer answer = unit(quantise_box(box, bits.coord));
      const bool meets = ray_meets_box(c.ray, box);
      ++answers.tests;
      answers.asked += answer == Answer::ask ? 1 : 0;
      answers.sure_hits += answer == Answer::hit ? 1 : 0;
      answers.wrong += answer != Answer::ask && (answer == Answer::hit) != meets ? 1 : 0;
    }
  }
  return answers;
}

TEST(AdaptiveSlabs, SureAnswerIsTheExactOneInEveryCategory) {
  for (const adversary::Category& category : adversary::categories())
    for (const hls::IntBits bits : {hls::IntBits{8, 8}, hls::IntBits{12, 12}, hls::IntBits{16, 24}})
      EXPECT_EQ(judged(category, bits, 400).wrong, 0) << category.name << " " << bits.coord;
}

TEST(AdaptiveSlabs, MoreBitsLeaveFewerTestsOpen) {
  const adversary::Category& random = adversary::categories().front();
  const Answers few = judged(random, {8, 8}, 1'000);
  const Answers many = judged(random, {16, 16}, 1'000);
  EXPECT_LT(many.asked * 5, few.asked);
  EXPECT_GT(few.asked, 0);
  EXPECT_GT(many.sure_hits, few.sure_hits);
}

}  // namespace
}  // namespace hitpipe::thesis::adaptive_slabs_test
