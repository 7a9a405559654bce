// Answers on their way out, with traffic of every kind: each leaves once, in the order in which they came,
// with the tag of its ray, whose number comes back once after that.
#include "hls/machines/replies.hpp"

#include <deque>

#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::rtl::replies_test {
namespace {

/// Shares of 8.
struct Traffic {
  int begins, answers, takes;
};

struct Answer {
  Word ray, tag, t, number, failed;
  int came;  ///< the cycle
};

class Rays {
 public:
  Rays(const hls::ReplyBits& bits, unsigned seed)
      : machine_("replies", bits),
        random_(seed),
        tags_(static_cast<std::size_t>(bits.rays())),
        errors_(tags_.size()) {
    for (Word ray = 0; ray < tags_.size(); ++ray) idle_.push_back(ray);
  }

  void cycle(const Traffic& traffic) {
    machine_.give();
    ASSERT_NO_FATAL_FAILURE(look_at_answer());
    ASSERT_NO_FATAL_FAILURE(look_at_number());

    machine_.in.scramble(random_);
    machine_.in["ray_ready"] = !idle_.empty() && of_eight(traffic.begins);
    machine_.in["answers"] = !begun_.empty() && of_eight(traffic.answers);
    machine_.in["hit_ready"] = of_eight(traffic.takes);
    if (machine_.out["hit_valid"] != 0 && machine_.in["hit_ready"] != 0) {
      left_.push_back(waiting_.front().ray);
      waiting_.pop_front();
      ++answers_left_;
    }
    if (machine_.in["answers"] != 0) answer();
    if (machine_.in["ray_ready"] != 0) begin();
    machine_.step();
    ++cycle_;
  }

  [[nodiscard]] int answers_left() const { return answers_left_; }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }
  [[nodiscard]] std::size_t idle() const { return idle_.size(); }

 private:
  bool of_eight(int share) { return random_.below(8) < share; }
  /// Takes any of them.
  Word any_of(std::deque<Word>& rays) {
    const auto which = rays.begin() + random_.below(static_cast<int>(rays.size()));
    const Word ray = *which;
    rays.erase(which);
    return ray;
  }

  /// It is the oldest until it is taken, so it does not change either.
  void look_at_answer() {
    const bool valid = machine_.out["hit_valid"] != 0;
    if (!waiting_.empty() && waiting_.front().came + 3 <= cycle_) {
      ASSERT_TRUE(valid) << "an answer can leave three cycles after it has come, or when the last has left";
    }
    if (!valid) return;
    ASSERT_FALSE(waiting_.empty()) << "in cycle " << cycle_;
    const Answer& answer = waiting_.front();
    ASSERT_EQ(machine_.out["hit_tag"], answer.tag) << "in cycle " << cycle_;
    ASSERT_EQ(machine_.out["hit_t"], answer.t) << "in cycle " << cycle_;
    ASSERT_EQ(machine_.out["hit_number"], answer.number) << "in cycle " << cycle_;
    ASSERT_EQ(machine_.out["hit_failed"], answer.failed) << "in cycle " << cycle_;
  }
  void look_at_number() {
    ASSERT_EQ(machine_.out["freed"] != 0, !left_.empty()) << "in cycle " << cycle_;
    if (left_.empty()) return;
    ASSERT_EQ(machine_.out["freed_ray"], left_.front()) << "in cycle " << cycle_;
    idle_.push_back(left_.front());
    left_.pop_front();
  }

  /// A ray begins where valid and ready are 1; the scrambled `valid` is often 0.
  void begin() {
    if (machine_.in["ray_valid"] == 0) return;
    const Word ray = any_of(idle_);
    machine_.in["begun_at"] = ray;
    tags_[static_cast<std::size_t>(ray)] = machine_.in["ray_tag"];
    errors_[static_cast<std::size_t>(ray)] = machine_.in["ray_error"];
    begun_.push_back(ray);
  }
  void answer() {
    const Word ray = any_of(begun_);
    machine_.in["answered"] = ray;
    waiting_.push_back(
        {ray, tags_[static_cast<std::size_t>(ray)], machine_.in["answer_t"], machine_.in["answer_number"],
         errors_[static_cast<std::size_t>(ray)] != 0 ? 1 : machine_.in["answer_failed"], cycle_});
  }

  NamedMachine machine_;
  Seeded random_;
  std::vector<Word> tags_, errors_;  ///< by ray
  std::deque<Word> idle_;            ///< numbers without a ray
  std::deque<Word> begun_;           ///< rays without an answer
  std::deque<Answer> waiting_;
  std::deque<Word> left_;  ///< whose numbers come back now
  int cycle_ = 0, answers_left_ = 0;
};

class RepliesIn : public testing::TestWithParam<hls::ReplyBits> {};

TEST_P(RepliesIn, LeaveOnceAndInOrder) {
  Rays rays(GetParam(), 21);
  Seeded random(22);
  constexpr Traffic kinds[] = {{8, 8, 8}, {8, 8, 1}, {8, 1, 8}, {1, 8, 8}, {4, 4, 4}, {8, 8, 0}, {8, 8, 7}};
  for (int period = 0; period < 600; ++period) {
    const Traffic& traffic = kinds[random.below(std::size(kinds))];
    for (int cycle = 0; cycle < 200; ++cycle) {
      ASSERT_NO_FATAL_FAILURE(rays.cycle(traffic));
    }
  }
  EXPECT_GT(rays.answers_left(), 4'000);
  for (int cycle = 0; cycle < 400; ++cycle) {
    ASSERT_NO_FATAL_FAILURE(rays.cycle({0, 8, 8}));
  }
  EXPECT_EQ(rays.idle(), static_cast<std::size_t>(GetParam().rays())) << "every number has come back";
}

TEST_P(RepliesIn, LeaveInEveryCycle) {
  Rays rays(GetParam(), 23);
  const int count = GetParam().rays();
  for (int cycle = 0; cycle < 40 * count + 40; ++cycle) {
    ASSERT_NO_FATAL_FAILURE(rays.cycle({8, 8, 0}));
  }
  ASSERT_EQ(rays.waiting(), static_cast<std::size_t>(count)) << "each ray has a place";
  for (int cycle = 0; cycle < count; ++cycle) {
    ASSERT_NO_FATAL_FAILURE(rays.cycle({0, 0, 8}));
  }
  EXPECT_EQ(rays.answers_left(), count);
}

INSTANTIATE_TEST_SUITE_P(Formats, RepliesIn,
                         testing::Values(hls::ReplyBits{}, hls::ReplyBits{4, 1, 1}, hls::ReplyBits{36, 64, 8},
                                         hls::ReplyBits{21, 7, 3}),
                         [](const auto& each) { return Format(each.param).identifier(); });

}  // namespace
}  // namespace hitpipe::rtl::replies_test
