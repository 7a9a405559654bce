// A cache with traffic of every kind: each block that is asked for is given once, with its own words, and no line
// is read that is there or on its way.
#include "hls/machines/cache.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sw_ref/memory/line_cache.hpp"
#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::sim::cache_test {
namespace {

using rtl::Word;
using Block = std::array<Word, 4>;

/// What the memory holds, until it changes.
Block block_of(Word number, int version) {
  Block block;
  for (std::size_t i = 0; i < block.size(); ++i)
    block[i] = (number * 4 + i + static_cast<Word>(version) * 0x1234'5678'9abcU) * 0x9e37'79b9'7f4a'7c15U &
               rtl::ones_below(64);
  return block;
}

/// Memory and rays around a cache. Numbers are shares of 16.
struct Traffic {
  int asks = 16;    ///< of the cycles, those in which a ray asks
  int takes = 16;   ///< in which memory takes a request
  int gives = 16;   ///< in which it gives a beat
  int errors = 0;   ///< of the beats have an error
  int blocks = 64;  ///< that rays ask for
};

class Bench {
 public:
  Bench(const hls::CacheBits& bits, unsigned seed) : bits_(bits), machine_("cache", bits), random_(seed) {
    for (Word ray = 0; ray < static_cast<Word>(bits.rays()); ++ray) idle_.push_back(ray);
    base_ = random_.bits() & rtl::ones_below(bits.bytes - 6);
  }

  void cycle(const Traffic& traffic) {
    machine_.give();
    look_at_block();
    machine_.in.scramble(random_);
    machine_.in["base"] = base_;
    machine_.in["most_lines"] = most_lines;
    machine_.in["empties_cache"] = empties;
    machine_.in["lets_asks"] = lets;
    empties = 0;
    ask(traffic);
    request(traffic);
    beat(traffic);
    machine_.step();
    ++cycle_;
  }
  /// Till nothing is on its way.
  void finish(Traffic traffic = {}) {
    traffic.asks = 0;
    for (int i = 0; i < 20'000 && !(waiting_.empty() && lines_.empty()); ++i) {
      ASSERT_NO_FATAL_FAILURE(cycle(traffic));
    }
    ASSERT_TRUE(waiting_.empty() && lines_.empty()) << "in cycle " << cycle_;
  }
  /// Asks for a block alone, and says whether its line was read.
  bool reads(Word block) {
    next_block_ = block;
    const std::size_t before = lines_read;
    for (int i = 0; i < 5'000 && next_block_; ++i) cycle({});
    EXPECT_FALSE(next_block_) << "the door stays closed";
    finish();
    return lines_read != before;
  }
  /// No ray is in flight, and the memory gets other words.
  void change_memory() { ++version_; }

  Word most_lines = 8, empties = 0, lets = 1;
  std::size_t blocks = 0, errors = 0, lines_read = 0, hits = 0, joins = 0, most_coming = 0;

 private:
  struct Asked {
    Word block;
    bool triangle;
  };
  struct Line {
    Word first, id;
    int beats = 0;
    bool error = false;
  };

  [[nodiscard]] Word line_of(Word block) const { return block / static_cast<Word>(bits_.blocks); }

  /// A ray gets the block that it asked for.
  void look_at_block() {
    hits += machine_.out["cache_hit"] != 0 ? 1 : 0;
    joins += machine_.out["cache_join"] != 0 ? 1 : 0;
    if (machine_.out["read_valid"] == 0) return;
    const Word id = machine_.out["read_id"], ray = id & rtl::ones_below(bits_.ray);
    const auto found = waiting_.find(ray);
    ASSERT_NE(found, waiting_.end()) << "ray " << static_cast<std::uint64_t>(ray) << " did not ask, cycle "
                                     << cycle_;
    const Asked asked = found->second;
    ASSERT_EQ(id >> bits_.ray != 0, asked.triangle)
        << "ray " << static_cast<std::uint64_t>(ray) << ", cycle " << cycle_;
    if (machine_.out["read_error"] != 0) {
      ++errors;
      // A list takes a cycle a ray, and may wait for another one.
      ASSERT_TRUE(spoilt_.contains(line_of(asked.block)) &&
                  cycle_ - spoilt_[line_of(asked.block)] < 2 * bits_.rays() + 8)
          << "block " << static_cast<std::uint64_t>(asked.block) << ", cycle " << cycle_;
    } else {
      const Block words = block_of(asked.block, version_);
      for (std::size_t i = 0; i < words.size(); ++i) {
        ASSERT_EQ(machine_.out[fmt::format("read_word_{}", i)], words[i])
            << "word " << i << " of block " << static_cast<std::uint64_t>(asked.block) << ", cycle "
            << cycle_;
      }
    }
    waiting_.erase(found);
    idle_.push_back(ray);
    ++blocks;
  }
  void ask(const Traffic& traffic) {
    machine_.in["asks"] = !idle_.empty() && (next_block_ || random_.below(16) < traffic.asks) ? 1 : 0;
    if (machine_.in["asks"] == 0) return;
    const std::size_t place = static_cast<std::size_t>(random_.below(static_cast<int>(idle_.size())));
    const Word ray = idle_[place];
    const Word block = next_block_ ? *next_block_ : static_cast<Word>(random_.below(traffic.blocks));
    const bool triangle = random_.below(2) != 0;
    machine_.in["asker"] = ray;
    machine_.in["asked_block"] = block;
    machine_.in["triangle"] = triangle ? 1 : 0;
    if (machine_.out["granted"] == 0) return;
    next_block_.reset();
    idle_.erase(idle_.begin() + static_cast<std::ptrdiff_t>(place));
    waiting_[ray] = {block, triangle};
  }
  void request(const Traffic& traffic) {
    machine_.in["request_ready"] = random_.below(16) < traffic.takes ? 1 : 0;
    const bool asks = machine_.out["request_valid"] != 0;
    const Word address = machine_.out["request_address"], id = machine_.out["request_id"];
    if (held_) {
      ASSERT_TRUE(asks) << "cycle " << cycle_;
      ASSERT_EQ(address, held_->first) << "cycle " << cycle_;
      ASSERT_EQ(id, held_->second) << "cycle " << cycle_;
    }
    held_.reset();
    if (!asks) return;
    if (machine_.in["request_ready"] == 0) {
      held_ = {address, id};
      return;
    }
    const Word line_bytes = 32 * static_cast<Word>(bits_.blocks);
    ASSERT_EQ(address % line_bytes, 0U);
    const Word first = ((address >> 5) - 2 * base_) & rtl::ones_below(bits_.bytes - 5);
    for (const Line& line : lines_) {
      ASSERT_NE(line.first, first) << "a line that is on its way, cycle " << cycle_;
      if (bits_.ids != 0) {
        ASSERT_NE(line.id, id) << "cycle " << cycle_;
      }
    }
    lines_.push_back({first, id});
    ++lines_read;
    most_coming = std::max(most_coming, lines_.size());
  }
  void beat(const Traffic& traffic) {
    // What was offered stays.
    if (!shown_ && !lines_.empty() && random_.below(16) < traffic.gives)
      shown_ = bits_.ids == 0 ? 0 : static_cast<std::size_t>(random_.below(static_cast<int>(lines_.size())));
    machine_.in["beat_valid"] = shown_ ? 1 : 0;
    if (!shown_) return;
    Line& line = lines_[*shown_];
    if (!shown_error_) shown_error_ = random_.below(16) < traffic.errors;
    machine_.in["beat_error"] = *shown_error_ ? 1 : 0;
    if (bits_.ids != 0) machine_.in["beat_id"] = line.id;
    const int lanes = bits_.data / 64, line_words = 4 * bits_.blocks;
    for (int lane = 0; lane < lanes; ++lane) {
      // A bus that is wider than the line has it where its address says.
      const int word = line_words < lanes ? lane - static_cast<int>(line.first % 2) * line_words
                                          : line.beats * lanes + lane;
      if (word < 0 || word >= line_words || *shown_error_) continue;
      const Block block = block_of(line.first + static_cast<Word>(word / 4), version_);
      machine_.in[fmt::format("beat_{}", lane)] = block[static_cast<std::size_t>(word % 4)];
    }
    if (machine_.out["beat_ready"] == 0) return;
    line.error = line.error || *shown_error_;
    const int beats = std::max(1, line_words / lanes);
    if (++line.beats == beats) {
      if (line.error) spoilt_[line_of(line.first)] = cycle_;
      lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(*shown_));
    }
    shown_.reset();
    shown_error_.reset();
  }

  hls::CacheBits bits_;
  rtl::NamedMachine machine_;
  rtl::Seeded random_;
  Word base_;
  int version_ = 0, cycle_ = 0;
  std::vector<Word> idle_;
  std::map<Word, Asked> waiting_;              ///< by ray
  std::vector<Line> lines_;                    ///< that memory is asked for
  std::map<Word, int> spoilt_;                 ///< lines with an error, and in which cycle it was known
  std::optional<std::pair<Word, Word>> held_;  ///< a request that memory has not taken
  std::optional<std::size_t> shown_;
  std::optional<bool> shown_error_;
  std::optional<Word> next_block_;
};

class CacheIn : public testing::TestWithParam<hls::CacheBits> {};

TEST_P(CacheIn, GivesEachBlockOnceWithItsWords) {
  rtl::Seeded random(7);
  std::size_t hits = 0, joins = 0, errors = 0, coming = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    Bench bench(GetParam(), seed);
    const Word limit = 1 + static_cast<Word>(random.below(6));
    bench.most_lines = limit;
    for (int period = 0; period < 40; ++period) {
      const Traffic traffic{.asks = random.below(17),
                            .takes = 1 + random.below(16),
                            .gives = 1 + random.below(16),
                            .errors = random.below(3) == 0 ? 2 : 0,
                            .blocks = 1 << (1 + random.below(10))};
      for (int cycle = 0; cycle < 100; ++cycle) {
        ASSERT_NO_FATAL_FAILURE(bench.cycle(traffic)) << "seed " << seed;
      }
      bench.lets = random.below(4) == 0 ? 0 : 1;
      bench.empties = random.below(8) == 0 ? 1 : 0;
    }
    ASSERT_NO_FATAL_FAILURE(bench.finish()) << "seed " << seed;
    EXPECT_LE(bench.most_coming, limit);
    EXPECT_EQ(bench.blocks, bench.hits + bench.joins + bench.lines_read);
    hits += bench.hits;
    joins += bench.joins;
    errors += bench.errors;
    coming = std::max(coming, bench.most_coming);
  }
  EXPECT_GT(hits, 500U);
  EXPECT_GT(joins, 50U);
  EXPECT_GT(errors, 50U);
  EXPECT_EQ(coming, std::min<std::size_t>(6, static_cast<std::size_t>(GetParam().rays())));
}

/// One ray after the other: the lines that it reads are those of the model.
TEST_P(CacheIn, HoldsTheLinesOfTheModel) {
  const hls::CacheBits& bits = GetParam();
  Bench bench(bits, 3);
  const std::uint64_t line_bytes = 32 * static_cast<std::uint64_t>(bits.blocks);
  ref::LineCache model({.bytes = line_bytes * static_cast<std::uint64_t>(bits.sets() * bits.ways),
                        .line_bytes = static_cast<std::uint32_t>(line_bytes),
                        .ways = static_cast<std::uint32_t>(bits.ways),
                        .replacement = ref::Replacement::by_age});
  rtl::Seeded random(4);
  const int lines = 3 * bits.sets() * bits.ways;
  std::size_t read = 0;
  for (int i = 0; i < 8 * lines; ++i) {
    const int spread = random.below(3) == 0 ? lines : std::max(2, lines / 8);
    const auto line = static_cast<std::uint32_t>(random.below(spread));
    const bool reads = !model.use(line);
    if (reads) model.place(line);
    ASSERT_EQ(
        bench.reads(line * static_cast<Word>(bits.blocks) + static_cast<Word>(random.below(bits.blocks))),
        reads)
        << "line " << i;
    read += reads ? 1 : 0;
  }
  EXPECT_GT(read, static_cast<std::size_t>(lines));
}

TEST_P(CacheIn, IsEmptied) {
  Bench bench(GetParam(), 5);
  for (Word line = 0; line < 4; ++line) EXPECT_TRUE(bench.reads(2 * line));
  for (Word line = 0; line < 4; ++line) EXPECT_FALSE(bench.reads(2 * line));
  bench.change_memory();
  bench.empties = 1;
  bench.cycle({.asks = 0});
  for (Word line = 0; line < 4; ++line) EXPECT_TRUE(bench.reads(2 * line));
}

/// A line that could not be read is read again.
TEST_P(CacheIn, KeepsNoLineWithAnError) {
  Bench bench(GetParam(), 6);
  const Traffic bad{.errors = 16, .blocks = 2};
  for (int i = 0; i < 200; ++i) {
    ASSERT_NO_FATAL_FAILURE(bench.cycle(bad));
  }
  bench.finish(bad);
  EXPECT_EQ(bench.hits, 0U);
  EXPECT_GT(bench.errors, 5U);
  EXPECT_TRUE(bench.reads(0));
  EXPECT_FALSE(bench.reads(0));
}

/// No new question is taken, and what was asked for still comes.
TEST_P(CacheIn, TakesNothingWhileRaysMayNotAsk) {
  Bench bench(GetParam(), 8);
  for (int i = 0; i < 200; ++i) bench.cycle({});
  bench.lets = 0;
  bench.cycle({});
  bench.cycle({});
  bench.finish();
  const std::size_t before = bench.blocks;
  for (int i = 0; i < 100; ++i) bench.cycle({});
  EXPECT_EQ(bench.blocks, before);
}

INSTANTIATE_TEST_SUITE_P(
    Formats, CacheIn,
    testing::Values(hls::CacheBits{24, 32, 5, 5, 8, 2, 256, 1}, hls::CacheBits{24, 32, 5, 2, 8, 2, 256, 0},
                    hls::CacheBits{16, 40, 3, 2, 4, 1, 64, 0}, hls::CacheBits{12, 20, 4, 1, 4, 2, 512, 0},
                    hls::CacheBits{12, 20, 5, 2, 2, 1, 512, 0}, hls::CacheBits{10, 15, 1, 1, 2, 2, 128, 0},
                    hls::CacheBits{20, 30, 4, 3, 4, 1, 256, 1}),
    [](const auto& each) { return Format(each.param).identifier(); });

}  // namespace
}  // namespace hitpipe::sim::cache_test
