// Beats with traffic of every kind: each block that was asked for comes once, in order, with the identifier
// of who asked and with its own words, however the beats come.
#include "hls/machines/beats.hpp"

#include <array>
#include <deque>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::rtl::beats_test {
namespace {

struct Read {
  Word id;
  bool upper;
  std::array<Word, 4> words;
  bool error = false;
};

class Bus {
 public:
  Bus(const hls::BeatBits& bits, unsigned seed) : bits_(bits), machine_("beats", bits), random_(seed) {}

  /// One cycle, with these shares of 8: the core asks, memory gives a beat.
  void cycle(int asks, int gives) {
    machine_.give();
    look_at_block();
    machine_.in.scramble(random_);
    machine_.in["beat_valid"] = !waiting_.empty() && random_.below(8) < gives;
    if (machine_.in["beat_valid"] != 0) show_beat();
    const bool taken = machine_.in["beat_valid"] != 0 && machine_.out["beat_ready"] != 0;
    if (asks == 0) machine_.in["request_valid"] = 0;
    if (machine_.in["request_valid"] != 0 && machine_.in["request_ready"] != 0) ask();
    if (taken) take_beat();
    machine_.step();
  }

  [[nodiscard]] int blocks() const { return blocks_; }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  /// It comes one cycle after its last beat.
  void look_at_block() {
    ASSERT_EQ(machine_.out["read_valid"] != 0, whole_.has_value()) << "block " << blocks_;
    if (!whole_) return;
    ASSERT_EQ(machine_.out["read_id"], whole_->id) << "block " << blocks_;
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_EQ(machine_.out[fmt::format("read_word_{}", i)], whole_->words[i]) << "block " << blocks_;
    }
    ASSERT_EQ(machine_.out["read_error"] != 0, whole_->error) << "block " << blocks_;
    whole_.reset();
    ++blocks_;
  }
  void show_beat() {
    const Read& read = waiting_.front();
    const int words = bits_.words();
    machine_.in["beat_error"] = random_.below(16) == 0;
    for (int i = 0; i < words; ++i) {
      const int at = words == 8 ? i - (read.upper ? 4 : 0) : beat_ * words + i;
      if (at >= 0 && at < 4)
        machine_.in[fmt::format("beat_{}", i)] = read.words[static_cast<std::size_t>(at)];
    }
  }
  void take_beat() {
    waiting_.front().error = waiting_.front().error || machine_.in["beat_error"] != 0;
    if (++beat_ < bits_.beats()) return;
    beat_ = 0;
    whole_ = waiting_.front();
    waiting_.pop_front();
    asking_.erase(whole_->id & ones_below(bits_.ray));
  }
  /// Of a ray that waits for nothing, if there is one.
  void ask() {
    const Word ray = machine_.in["request_id"] & ones_below(bits_.ray);
    if (!asking_.insert(ray).second) {
      machine_.in["request_valid"] = 0;
      return;
    }
    Read read{machine_.in["request_id"], bits_.data == 512 && machine_.in["request_upper"] != 0, {}};
    for (Word& word : read.words) word = random_.bits() & ones_below(64);
    waiting_.push_back(read);
  }

  hls::BeatBits bits_;
  NamedMachine machine_;
  Seeded random_;
  std::deque<Read> waiting_;
  std::set<Word> asking_;
  std::optional<Read> whole_;
  int beat_ = 0, blocks_ = 0;
};

class BeatsIn : public testing::TestWithParam<hls::BeatBits> {};

TEST_P(BeatsIn, MakeBlocksInOrder) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Bus bus(GetParam(), seed);
    Seeded random(seed + 100);
    for (int period = 0; period < 40; ++period) {
      const int asks = random.below(2), gives = random.below(9);
      for (int cycle = 0; cycle < 100; ++cycle) {
        ASSERT_NO_FATAL_FAILURE(bus.cycle(asks, gives));
      }
    }
    EXPECT_GT(bus.blocks(), 100);
    for (int cycle = 0; cycle < 2'000; ++cycle) {
      ASSERT_NO_FATAL_FAILURE(bus.cycle(0, 8));
    }
    EXPECT_EQ(bus.waiting(), 0U);
  }
}

TEST_P(BeatsIn, TakeABeatInEveryCycle) {
  Bus bus(GetParam(), 30);
  // So many that the queue is not empty for long.
  for (int cycle = 0; cycle < 20 * GetParam().rays(); ++cycle) {
    ASSERT_NO_FATAL_FAILURE(bus.cycle(1, 0));
  }
  const auto waiting = static_cast<int>(bus.waiting());
  ASSERT_GT(waiting, GetParam().rays() / 2);
  for (int cycle = 0; cycle < waiting * GetParam().beats() + 1; ++cycle) {
    ASSERT_NO_FATAL_FAILURE(bus.cycle(0, 8));
  }
  EXPECT_EQ(bus.blocks(), waiting);
}

INSTANTIATE_TEST_SUITE_P(Formats, BeatsIn,
                         testing::Values(hls::BeatBits{64, 5}, hls::BeatBits{128, 1}, hls::BeatBits{256, 3},
                                         hls::BeatBits{512, 8}, hls::BeatBits{64, 2}),
                         [](const auto& each) { return Format(each.param).identifier(); });

}  // namespace
}  // namespace hitpipe::rtl::beats_test
