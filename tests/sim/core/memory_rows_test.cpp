// Rows, banks and refreshes of the memory model, in cycles.
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "sim/core/memory_model.hpp"

namespace hitpipe::sim::memory_rows_test {
namespace {

/// Reads one after the other, each as soon as the one before has come.
TEST(MemoryRows, ReadsTakeLongerWhereTheirRowIsNotOpen) {
  std::vector<ref::CoreBlock> blocks(64);
  MemoryModel memory(blocks, {.least_latency = 10,
                              .most_latency = 10,
                              .rows = {.row_bytes = 64,
                                       .banks = 2,
                                       .bank_cycles = 100,
                                       .closed_cycles = 1000,
                                       .row_cycles = 3000,
                                       .refresh_every = 20'000,
                                       .refresh_cycles = 5000}});
  const auto cycles = [&](std::uint32_t block) {
    memory.ask(block, 0);
    int count = 1;
    while (!memory.step()) ++count;
    return count;
  };
  // A row has two blocks, and rows are in banks 0 and 1 by turns.
  EXPECT_EQ(cycles(0), 10 + 1000);
  EXPECT_EQ(cycles(1), 10);
  EXPECT_EQ(cycles(2), 10 + 100 + 1000);  // the other bank
  EXPECT_EQ(cycles(0), 10 + 100);
  EXPECT_EQ(cycles(4), 10 + 3000);  // another row of this bank
  EXPECT_EQ(cycles(3), 10 + 100);
  EXPECT_EQ(cycles(0), 10 + 100 + 3000);
  while (memory.counts().cycles < 20'000) memory.step();
  EXPECT_EQ(cycles(0), 10 + 5000 + 1000);  // a refresh has closed all rows
  EXPECT_EQ(cycles(1), 10);
}

}  // namespace
}  // namespace hitpipe::sim::memory_rows_test
