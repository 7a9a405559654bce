// A cache of any shape against its definition.
#include "sw_ref/memory/line_cache.hpp"

#include <algorithm>
#include <list>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sw_ref/memory/aged_set.hpp"

namespace hitpipe::ref::line_cache_test {
namespace {

std::uint64_t fetched(const std::vector<std::uint32_t>& lines, const CacheShape& shape) {
  LineCache cache(shape);
  std::uint64_t count = 0;
  for (const std::uint32_t line : lines) {
    if (cache.use(line)) continue;
    ++count;
    cache.place(line);
  }
  return count;
}

/// The simplest form: a list for each set, the newest line first.
std::uint64_t plain(const std::vector<std::uint32_t>& lines, std::size_t sets, std::size_t ways) {
  std::map<std::size_t, std::list<std::uint32_t>> newest_first;
  std::uint64_t count = 0;
  for (const std::uint32_t line : lines) {
    std::list<std::uint32_t>& set = newest_first[line % sets];
    const auto at = std::find(set.begin(), set.end(), line);
    if (at != set.end())
      set.erase(at);
    else
      ++count;
    set.push_front(line);
    if (set.size() > ways) set.pop_back();
  }
  return count;
}

TEST(LineCache, ByAgeFetchesWhatItsDefinitionDoes) {
  constexpr unsigned seed = 61;
  std::mt19937 random(seed);
  for (const std::uint32_t ways : {1U, 2U, 4U, 8U, 16U}) {
    constexpr std::uint32_t sets = 4;
    LineCache cache({.bytes = 64 * sets * ways, .ways = ways, .replacement = Replacement::by_age});
    std::vector<AgedSet> plain_sets(sets, AgedSet(ways));
    for (int i = 0; i < 5000; ++i) {
      const auto line =
          static_cast<std::uint32_t>(random() % (random() % 3 == 0 ? 10 * sets * ways : 2 * sets));
      const bool fetches = !cache.use(line);
      AgedSet& plain_set = plain_sets[line % sets];
      ASSERT_EQ(fetches, !plain_set.use(line)) << "seed " << seed << ", " << ways << " ways, line " << i;
      if (!fetches) continue;
      cache.place(line);
      plain_set.place(line);
    }
  }
}

TEST(LineCache, FetchesWhatLeastRecentlyUsedListsDo) {
  constexpr unsigned seed = 58;
  std::mt19937 random(seed);
  const auto below = [&random](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
  for (int round = 0; round < 500; ++round) {
    std::vector<std::uint32_t> lines(300);
    const std::uint32_t spread = 1 + below(64);
    for (std::uint32_t& line : lines) line = below(spread);
    const std::uint32_t sets = 1 + below(6);
    const std::uint32_t ways = 1 + below(9);
    const CacheShape shape{.bytes = 64 * std::uint64_t{sets} * ways, .ways = ways};
    ASSERT_EQ(fetched(lines, shape), plain(lines, sets, ways)) << "seed " << seed << ", round " << round;
    const CacheShape one_set{.bytes = 4096 * std::uint64_t{ways}, .line_bytes = 4096, .ways = 0};
    ASSERT_EQ(fetched(lines, one_set), plain(lines, 1, ways)) << "seed " << seed << ", round " << round;
  }
}

TEST(LineCache, OfNoBytesHoldsNothing) {
  EXPECT_EQ(fetched({1, 1, 2, 1}, {}), 4U);
  EXPECT_EQ(message_of<std::invalid_argument>([] { return LineCache({.bytes = 1, .line_bytes = 0}); }),
            "a cache with lines of 0 bytes");
}

TEST(LineCache, HasAtLeastOneSet) {
  EXPECT_EQ(fetched({1, 2, 1, 2}, {.bytes = 64}), 2U) << "eight ways";
  EXPECT_EQ(fetched({1, 2, 1, 2}, {.bytes = 64, .ways = 1}), 4U);
}

TEST(LineCache, MoreRoomNeverFetchesMore) {
  std::mt19937 random(59);
  std::vector<std::uint32_t> lines(2000);
  for (std::uint32_t& line : lines) line = random() % 40 * (random() % 40) % 64;
  std::uint64_t before = lines.size() + 1;
  for (std::uint64_t room = 1; room <= 64; ++room) {
    const std::uint64_t count = fetched(lines, {.bytes = 64 * room, .ways = 0});
    ASSERT_LE(count, before) << room;
    before = count;
  }
}

}  // namespace
}  // namespace hitpipe::ref::line_cache_test
