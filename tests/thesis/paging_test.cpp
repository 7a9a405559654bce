// The paging model against its definition.
#include "thesis/paging.hpp"

#include <list>
#include <random>

#include <gtest/gtest.h>

namespace hitpipe::thesis::paging_test {
namespace {

constexpr std::uint64_t page = PagedMemory::page_bytes;

std::uint64_t faults_of(const std::vector<std::uint64_t>& addresses, std::uint64_t pages_of_room) {
  PagedMemory memory(pages_of_room * page);
  (void)memory.add_array(64 * page);
  for (const std::uint64_t address : addresses) memory.read(address, 1);
  return memory.faults();
}

/// The simplest form of a least recently used cache.
std::uint64_t plain_faults(const std::vector<std::uint64_t>& addresses, std::uint64_t pages_of_room) {
  std::list<std::uint64_t> newest_first;
  std::uint64_t faults = 0;
  for (const std::uint64_t address : addresses) {
    const auto at = std::find(newest_first.begin(), newest_first.end(), address / page);
    if (at != newest_first.end())
      newest_first.erase(at);
    else
      ++faults;
    newest_first.push_front(address / page);
    if (newest_first.size() > pages_of_room) newest_first.pop_back();
  }
  return faults;
}

TEST(PagedMemory, FaultsAsALeastRecentlyUsedListDoes) {
  constexpr unsigned seed = 58;
  std::mt19937 random(seed);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint64_t> addresses(300);
    const std::uint64_t spread = 1 + random() % 64;
    for (std::uint64_t& address : addresses) address = random() % (spread * page);
    const std::uint64_t room = 1 + random() % 20;
    ASSERT_EQ(faults_of(addresses, room), plain_faults(addresses, room))
        << "seed " << seed << ", round " << round;
  }
}

TEST(PagedMemory, ReadOverAPageEndTouchesBothPages) {
  PagedMemory memory(10 * page);
  const std::uint64_t array = memory.add_array(2 * page);
  memory.read(array + page - 2, 4);
  EXPECT_EQ(memory.faults(), 2U);
  memory.read(array, 2 * page);
  EXPECT_EQ(memory.faults(), 2U);
}

TEST(PagedMemory, ArraysShareNoPage) {
  PagedMemory memory(10 * page);
  const std::uint64_t one = memory.add_array(1);
  const std::uint64_t other = memory.add_array(1);
  memory.read(one, 1);
  memory.read(other, 1);
  EXPECT_EQ(memory.faults(), 2U);
}

TEST(PagedMemory, MoreRoomNeverFaultsMore) {
  std::mt19937 random(59);
  std::vector<std::uint64_t> addresses(2000);
  for (std::uint64_t& address : addresses) address = random() % 40 * (random() % 40) % 64 * page;
  std::uint64_t before = addresses.size() + 1;
  for (std::uint64_t room = 1; room <= 64; ++room) {
    const std::uint64_t faults = faults_of(addresses, room);
    ASSERT_LE(faults, before) << room;
    before = faults;
  }
}

}  // namespace
}  // namespace hitpipe::thesis::paging_test
