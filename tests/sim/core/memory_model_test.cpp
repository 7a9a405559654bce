// The memory model answers every request once with its block, when its description says, and counts what a
// slow model of the same description counts.
#include "sim/core/memory_model.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/core/slow_memory.hpp"

namespace hitpipe::sim::memory_model_test {
namespace {

constexpr std::uint64_t seed = 5;
constexpr std::uint32_t image_blocks = 1001;  // the last line has one block

const std::vector<ref::CoreBlock>& image() {
  static const std::vector<ref::CoreBlock> blocks = [] {
    ref::adversary::Random random(seed);
    std::vector<ref::CoreBlock> drawn(image_blocks);
    for (ref::CoreBlock& block : drawn)
      for (std::uint64_t& word : block) word = random.bits();
    return drawn;
  }();
  return blocks;
}
ref::CoreBlock block_at(std::uint32_t number) {
  return number < image().size() ? image()[number] : ref::CoreBlock{};
}

std::string text(const MemoryOptions& o) {
  return fmt::format(
      "latency {} to {}, in order {}, interval {} and {}, refused {} %, waiting {}, cache {} KiB of {}",
      o.least_latency, o.most_latency, o.in_order, o.interval, o.line_interval, o.refused_percent,
      o.most_waiting, o.cache_kib, o.hit_latency);
}

std::vector<MemoryOptions> combinations() {
  std::vector<MemoryOptions> all;
  int turn = 0;
  for (const auto& [least, most] : {std::pair{1, 1}, {37, 37}, {1, 200}, {3, 9}})
    for (const bool in_order : {false, true})
      for (const int interval : {1, 3})
        for (const int refused_percent : {0, 40})
          for (const int most_waiting : {0, 5})
            for (const int cache_kib : {0, 1, 4})
              all.push_back({.least_latency = least,
                             .most_latency = most,
                             .in_order = in_order,
                             .interval = interval,
                             .line_interval = 5 - interval,
                             .refused_percent = refused_percent,
                             .most_waiting = most_waiting,
                             .cache_kib = cache_kib,
                             .hit_latency = std::array{1, 4, 50, 7, 2}[static_cast<std::size_t>(turn++ % 5)],
                             .seed = seed + static_cast<std::uint64_t>(turn)});
  return all;
}

/// Near the block before, or anywhere, or outside.
class Walker {
 public:
  std::uint32_t next() {
    const std::uint64_t kind = random_.below(32);
    if (kind == 0)
      return random_.coin() ? 0xFFFF'FFFF : image_blocks + static_cast<std::uint32_t>(random_.below(3));
    // Lines that share a bucket of lines on their way.
    if (kind < 5) return here_ + 8192 * static_cast<std::uint32_t>(1 + random_.below(3));
    if (kind < 14) here_ = static_cast<std::uint32_t>(random_.below(image_blocks));
    return std::min<std::uint32_t>(here_ + static_cast<std::uint32_t>(random_.below(12)), image_blocks - 1);
  }
  bool asks() { return random_.below(4) > 0; }

 private:
  ref::adversary::Random random_{seed};
  std::uint32_t here_ = 0;
};

struct Asked {
  std::uint32_t block;
  std::uint64_t cycle;
  bool hit;
};
struct Answered {
  std::uint32_t tag;
  std::uint64_t cycle;
  bool operator==(const Answered&) const = default;
};
struct Traffic {
  std::vector<Asked> asked;  ///< at the place of its tag
  std::vector<Answered> answered;
  MemoryCounts counts;
  std::uint64_t most_waiting = 0;
};

/// Random requests for `cycles`, and then until nothing waits. Expects the blocks that were asked for.
Traffic traffic(const MemoryOptions& options, std::uint64_t cycles) {
  MemoryModel memory(image(), options);
  Walker walker;
  Traffic traffic;
  std::uint64_t cycle = 0;
  while (cycle < cycles || (memory.waiting() > 0 && cycle < 10 * cycles + 100'000)) {
    if (cycle < cycles && walker.asks() && memory.ready()) {
      const std::uint32_t block = walker.next();
      const std::uint64_t hits = memory.counts().hits;
      memory.ask(block, static_cast<std::uint32_t>(traffic.asked.size()));
      traffic.asked.push_back({block, cycle, memory.counts().hits > hits});
    }
    traffic.most_waiting = std::max(traffic.most_waiting, memory.waiting());
    const std::optional<MemoryAnswer> answer = memory.step();
    ++cycle;
    if (!answer) continue;
    traffic.answered.push_back({answer->tag, cycle});
    EXPECT_LT(answer->tag, traffic.asked.size());
    if (answer->tag < traffic.asked.size()) {
      EXPECT_EQ(answer->block, block_at(traffic.asked[answer->tag].block));
    }
  }
  traffic.counts = memory.counts();
  return traffic;
}

TEST(MemoryModel, AnswersEveryRequestOnceWithItsBlock) {
  for (const MemoryOptions& options : combinations()) {
    SCOPED_TRACE(text(options));
    const Traffic t = traffic(options, 2000);
    ASSERT_GT(t.asked.size(), 30U);
    std::vector<int> answers(t.asked.size());
    std::uint64_t outside = 0;
    for (const Asked& asked : t.asked) outside += asked.block >= image_blocks ? 1 : 0;
    for (std::size_t i = 0; i < t.answered.size(); ++i) {
      const Answered& answered = t.answered[i];
      const Asked& asked = t.asked.at(answered.tag);
      ++answers[answered.tag];
      const std::uint64_t took = answered.cycle - asked.cycle;
      if (options.cache_kib == 0) {
        EXPECT_GE(took, static_cast<std::uint64_t>(options.least_latency));
      }
      if (asked.hit) {
        EXPECT_GE(took, static_cast<std::uint64_t>(options.hit_latency));
      }
      if (options.in_order) {
        EXPECT_EQ(answered.tag, i);
      }
      const int apart = options.cache_kib == 0 ? options.interval : 1;
      if (i > 0) {
        EXPECT_GE(answered.cycle - t.answered[i - 1].cycle, static_cast<std::uint64_t>(apart));
      }
    }
    EXPECT_EQ(answers, std::vector<int>(t.asked.size(), 1));
    EXPECT_EQ(t.counts.requests, t.asked.size());
    EXPECT_EQ(t.counts.answers, t.answered.size());
    EXPECT_EQ(t.counts.hits + t.counts.misses, t.counts.requests);
    EXPECT_EQ(t.counts.outside, outside);
    EXPECT_GT(outside, 0U);
    EXPECT_EQ(t.counts.most_waiting, t.most_waiting);
    if (options.most_waiting > 0) {
      EXPECT_LE(t.most_waiting, static_cast<std::uint64_t>(options.most_waiting));
    }
  }
}

TEST(MemoryModel, DoesInEveryCycleWhatTheSlowModelDoes) {
  MemoryCounts sum;
  for (const MemoryOptions& options : combinations()) {
    SCOPED_TRACE(text(options));
    MemoryModel memory(image(), options);
    SlowMemory slow(image(), options);
    Walker walker;
    for (std::uint32_t cycle = 0; cycle < 3000; ++cycle) {
      if (memory.ready() && cycle < 2000 && walker.asks()) {
        const std::uint32_t block = walker.next();
        memory.ask(block, cycle);
        slow.ask(block, cycle);
      }
      ASSERT_EQ(memory.step(), slow.step()) << "cycle " << cycle;
    }
    ASSERT_EQ(memory.counts(), slow.counts);
    sum.hits += slow.counts.hits;
    sum.misses += slow.counts.misses;
    sum.merged += slow.counts.merged;
  }
  EXPECT_GT(sum.hits, 10'000U);
  EXPECT_GT(sum.misses - sum.merged, 10'000U);
  EXPECT_GT(sum.merged, 10'000U);
}

/// The cycles from asking for a block to its answer, alone in the memory.
std::uint64_t alone(MemoryModel& memory, std::uint32_t block = 0) {
  memory.ask(block, 0);
  for (std::uint64_t cycles = 1; cycles <= MemoryOptions::most_cycles; ++cycles)
    if (memory.step()) return cycles;
  return 0;
}

TEST(MemoryModel, AloneARequestTakesItsLatency) {
  for (const int latency : {1, 2, 100, 9'999, 10'000}) {
    for (const int spread : {0, 1}) {
      const int least = std::max(latency - spread, 1);
      MemoryModel memory(image(), {.least_latency = least, .most_latency = latency});
      std::map<std::uint64_t, int> seen;
      for (int i = 0; i < 50; ++i) ++seen[alone(memory)];
      EXPECT_EQ(seen.size(), latency > least ? 2U : 1U);
      EXPECT_EQ(seen.begin()->first, static_cast<std::uint64_t>(least));
      EXPECT_EQ(seen.rbegin()->first, static_cast<std::uint64_t>(latency));
    }
  }
}

TEST(MemoryModel, RandomLatenciesAreUniform) {
  MemoryModel memory(image(), {.least_latency = 3, .most_latency = 10, .seed = seed});
  std::map<std::uint64_t, int> seen;
  for (int i = 0; i < 8000; ++i) ++seen[alone(memory)];
  EXPECT_EQ(seen.size(), 8U);
  for (const auto& [latency, times] : seen) {
    EXPECT_TRUE(latency >= 3 && latency <= 10) << latency;
    EXPECT_NEAR(times, 1000, 100) << latency;  // more than three standard deviations
  }
}

/// With a request in every cycle in which it is ready: the cycles in which it answered.
template <class Block>
std::vector<std::uint64_t> busy(const MemoryOptions& options, std::uint64_t cycles, const Block& block) {
  MemoryModel memory(image(), options);
  std::vector<std::uint64_t> answered;
  for (std::uint32_t cycle = 0; cycle < cycles; ++cycle) {
    if (memory.ready()) memory.ask(block(cycle), cycle);
    if (memory.step()) answered.push_back(cycle + 1);
  }
  return answered;
}

TEST(MemoryModel, ABusyMemoryGivesABlockInEachInterval) {
  const auto any = [](std::uint32_t cycle) { return cycle * 37 % image_blocks; };
  for (const bool in_order : {false, true}) {
    for (const int interval : {1, 2, 5}) {
      SCOPED_TRACE(fmt::format("in order {}, interval {}", in_order, interval));
      const auto step = static_cast<std::uint64_t>(interval);
      const std::vector<std::uint64_t> fixed = busy(
          {.least_latency = 20, .most_latency = 20, .in_order = in_order, .interval = interval}, 1000, any);
      ASSERT_EQ(fixed.size(), (1000 - 20) / step + 1);
      for (std::size_t i = 0; i < fixed.size(); ++i) EXPECT_EQ(fixed[i], 20 + i * step);
      // In order the first ones wait for older ones, later all that is asked for is overdue.
      const std::vector<std::uint64_t> drawn = busy(
          {.least_latency = 1, .most_latency = 50, .in_order = in_order, .interval = interval}, 1000, any);
      EXPECT_GE(drawn.size(), (1000 - 50) / step);
      for (std::size_t i = 1; i < drawn.size(); ++i) EXPECT_GE(drawn[i] - drawn[i - 1], step);
    }
  }
}

TEST(MemoryModel, ALineTakesItsTimeAndAHitNone) {
  const MemoryOptions options{.least_latency = 20, .most_latency = 20, .line_interval = 7, .cache_kib = 16};
  const std::vector<std::uint64_t> lines = busy(options, 500, [](std::uint32_t cycle) { return 2 * cycle; });
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i], 20 + 7 * i);
  EXPECT_EQ(lines.size(), 69U);

  // The line is there from cycle 20; until then everybody waits for it.
  const std::vector<std::uint64_t> one = busy(options, 500, [](std::uint32_t cycle) { return cycle % 2; });
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i], 20 + i);
  EXPECT_EQ(one.size(), 481U);

  // A hit passes a miss.
  MemoryModel memory(image(), options);
  EXPECT_EQ(alone(memory, 0), 20U);
  EXPECT_EQ(alone(memory, 1), 4U);
  memory.ask(2, 0);
  EXPECT_FALSE(memory.step());
  memory.ask(1, 1);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(memory.step());
  EXPECT_EQ(memory.step(), (MemoryAnswer{1, 1, block_at(1)}));
}

// 1 KiB are two sets of eight lines; the lines of even numbers, so blocks 0, 4, 8 and so on, share a set.
TEST(MemoryModel, TheOldestLineMakesRoom) {
  MemoryModel memory(image(), {.least_latency = 1, .most_latency = 1, .cache_kib = 1});
  const auto hits = [&](std::uint32_t even_line, std::uint32_t half = 0) {
    const std::uint64_t before = memory.counts().hits;
    alone(memory, 4 * even_line + half);
    return memory.counts().hits > before;
  };
  for (std::uint32_t line = 0; line < 8; ++line) EXPECT_FALSE(hits(line));
  for (std::uint32_t odd = 0; odd < 20; ++odd) alone(memory, 4 * odd + 2);  // the other set
  EXPECT_TRUE(hits(0, 1));
  EXPECT_FALSE(hits(8));  // for line 1, the first of the oldest
  EXPECT_TRUE(hits(0));
  EXPECT_TRUE(hits(2));
  EXPECT_FALSE(hits(1, 1));  // for line 3
  EXPECT_TRUE(hits(4));
  EXPECT_FALSE(hits(3));  // for line 5
  EXPECT_TRUE(hits(6));
  EXPECT_TRUE(hits(7));  // there is no old one now, so all get older
  EXPECT_TRUE(hits(8));
  EXPECT_TRUE(hits(1));
  EXPECT_FALSE(hits(5));  // for line 3
  EXPECT_TRUE(hits(0));
  EXPECT_TRUE(hits(4));
  EXPECT_FALSE(hits(3));  // for line 5
  const MemoryCounts& counts = memory.counts();
  EXPECT_EQ(counts.hits, 10U);
  EXPECT_EQ(counts.misses, 8U + 20U + 5U);
  EXPECT_EQ(counts.merged, 0U);
  EXPECT_EQ(counts.bytes_read, 64 * counts.misses);
}

TEST(MemoryModel, MissesOfALineOnItsWayAreOneRead) {
  MemoryModel memory(image(), {.least_latency = 10, .most_latency = 10, .cache_kib = 1});
  const std::array<std::uint32_t, 4> blocks{6, 7, 6, 8};
  std::vector<Answered> answered;
  for (std::uint32_t cycle = 0; cycle < 20; ++cycle) {
    if (cycle < blocks.size()) memory.ask(blocks[cycle], cycle);
    if (cycle == 14) memory.ask(7, 4);
    if (const auto answer = memory.step()) {
      answered.push_back({answer->tag, cycle + 1});
      EXPECT_EQ(answer->block, block_at(answer->tag == 4 ? 7 : blocks.at(answer->tag)));
    }
  }
  EXPECT_TRUE(answered == (std::vector<Answered>{{0, 10}, {1, 11}, {2, 12}, {3, 13}, {4, 18}}));
  EXPECT_EQ(memory.counts(), (MemoryCounts{.cycles = 20,
                                           .requests = 5,
                                           .outside = 0,
                                           .hits = 1,
                                           .misses = 4,
                                           .merged = 2,
                                           .bytes_read = 128,
                                           .answers = 5,
                                           .most_waiting = 4}));
}

TEST(MemoryModel, RefusesItsShareOfCyclesWhateverIsAsked) {
  const MemoryOptions options{.refused_percent = 40, .seed = seed};
  MemoryModel asked(image(), options);
  MemoryModel idle(image(), options);
  int taken = 0;
  for (std::uint32_t cycle = 0; cycle < 20'000; ++cycle) {
    ASSERT_EQ(asked.ready(), idle.ready());
    if (asked.ready()) {
      asked.ask(cycle % image_blocks, cycle);
      ++taken;
    }
    asked.step();
    idle.step();
  }
  EXPECT_NEAR(taken, 12'000, 300);
}

TEST(MemoryModel, TakesNoMoreThanMayWait) {
  const auto any = [](std::uint32_t cycle) { return cycle; };
  const std::vector<std::uint64_t> answered =
      busy({.least_latency = 10, .most_latency = 10, .most_waiting = 3}, 40, any);
  // The place of an answer is free in the cycle in which the core sees it.
  EXPECT_EQ(answered, (std::vector<std::uint64_t>{10, 11, 12, 20, 21, 22, 30, 31, 32, 40}));
}

TEST(MemoryModel, IsTheSameOnEveryMachine) {
  const MemoryOptions options{.least_latency = 1, .most_latency = 200, .refused_percent = 10, .seed = 1};
  const Traffic once = traffic(options, 1000);
  EXPECT_TRUE(once.answered == traffic(options, 1000).answered);
  MemoryOptions other = options;
  other.seed = 2;
  EXPECT_FALSE(once.answered == traffic(other, 1000).answered);
  ASSERT_GE(once.answered.size(), 5U);
  std::string first;
  for (std::size_t i = 0; i < 5; ++i)
    first += fmt::format("{}@{} ", once.answered[i].tag, once.answered[i].cycle);
  EXPECT_EQ(first, "6@22 18@32 5@34 19@36 16@37 ");
}

TEST(MemoryModel, IsAskedOnlyWhereItIsReadyAndOnceInACycle) {
  MemoryModel memory(image(), {.most_waiting = 1});
  memory.ask(0, 0);
  EXPECT_EQ(message_of<std::logic_error>([&] { memory.ask(1, 1); }), "a memory was asked twice in a cycle");
  memory.step();
  EXPECT_FALSE(memory.ready());
  EXPECT_EQ(message_of<std::logic_error>([&] { memory.ask(1, 1); }),
            "a memory was asked in a cycle in which it is not ready");
}

TEST(MemoryModel, SaysWhichOptionsAreAllowed) {
  const auto refusal = [](const MemoryOptions& options) {
    return message_of<std::invalid_argument>([&] { MemoryModel(image(), options); });
  };
  EXPECT_EQ(refusal({.least_latency = 0}), "a memory's latency of 0 cycles: allowed is 1 to 10000");
  EXPECT_EQ(refusal({.most_latency = 10'001}), "a memory's latency of 10001 cycles: allowed is 1 to 10000");
  EXPECT_EQ(refusal({.least_latency = 9, .most_latency = 8}),
            "a memory's latency of 9 to 8 cycles: the least comes first");
  EXPECT_EQ(refusal({.interval = 0}), "a memory's interval of 0 cycles: allowed is 1 to 10000");
  EXPECT_EQ(refusal({.line_interval = 0}), "a memory's interval of lines of 0 cycles: allowed is 1 to 10000");
  EXPECT_EQ(refusal({.hit_latency = 0}), "a memory's hit latency of 0 cycles: allowed is 1 to 10000");
  for (const int percent : {-1, 100})
    EXPECT_EQ(refusal({.refused_percent = percent}),
              fmt::format("a memory that refuses in {} % of the cycles: allowed is 0 to 99", percent));
  EXPECT_EQ(refusal({.most_waiting = -1}),
            "a memory with at most -1 requests on their way: allowed is 1 or more, or 0 for no limit");
  for (const int kib : {-1, 3, 131'072})
    EXPECT_EQ(refusal({.cache_kib = kib}),
              fmt::format("a cache of {} KiB: allowed is 0 or a power of two up to 65536", kib));
  EXPECT_EQ(
      refusal({.least_latency = 10'000, .most_latency = 10'000, .refused_percent = 99, .cache_kib = 65'536}),
      "no exception");
}

}  // namespace
}  // namespace hitpipe::sim::memory_model_test
