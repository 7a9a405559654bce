// Memories by their figures: built-in ones, files, and what is refused.
#include "sim/core/memory_port.hpp"

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::memory_port_test {
namespace {

auto figures(const MemoryPort& p) {
  return std::tuple(p.least_latency, p.most_latency, p.beat_bytes, p.beat_cycles, p.burst_cycles,
                    p.refused_percent);
}
auto figures(const std::string& text) {
  return figures(memory_port(text));
}

TEST(MemoryPort, IsOneByName) {
  EXPECT_EQ(figures("ideal"), std::tuple(100, 100, 32, 1, 0, 0));
  const MemoryPort dram = memory_port("dram");
  EXPECT_EQ(dram.least_latency, 30);
  EXPECT_EQ(dram.cycles_of(32), 9);
  EXPECT_EQ(dram.cycles_of(64), 12);
  EXPECT_EQ(memory_port("axi-256").cycles_of(64), 2);
  for (const KnownMemory& each : known_memories())
    EXPECT_EQ(figures(std::string(each.name)), figures(each.port));
}

TEST(MemoryPort, HasFiguresBehindItsName) {
  EXPECT_EQ(figures("ideal,latency=1..200,refused_percent=10"), std::tuple(1, 200, 32, 1, 0, 10));
  EXPECT_EQ(figures("dram,latency=7,beat_bytes=16,beat_cycles=2,burst_cycles=5"),
            std::tuple(7, 7, 16, 2, 5, 0));
}

TEST(MemoryPort, IsAFile) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("m.json", R"({"latency": [3, 9], "beat_bytes": 8, "burst_cycles": 4})").string();
  EXPECT_EQ(figures(file), std::tuple(3, 9, 8, 1, 4, 0));
  EXPECT_EQ(figures(file + ",latency=5"), std::tuple(5, 5, 8, 1, 4, 0));
  EXPECT_EQ(memory_port(file).cycles_of(32), 8);
  const std::string rows =
      folder
          .write("rows.json", R"({"row_bytes": 1024, "banks": 4, "row_cycles": 9, "refresh_every": 100000})")
          .string();
  const DramRows made = memory_port(rows).rows;
  EXPECT_EQ(std::tuple(made.row_bytes, made.banks, made.row_cycles, made.refresh_every),
            std::tuple(1024, 4, 9, 100'000));
}

/// A bus that is narrower than the memory's port is the limit.
TEST(MemoryPort, IsBehindTheBusOfACore) {
  const MemoryOptions wide = memory_behind(memory_port("dram"), {});
  EXPECT_EQ(wide.interval, 9);
  EXPECT_EQ(wide.line_interval, 12);
  const MemoryOptions narrow = memory_behind(memory_port("axi-256"), {.data_bits = 64});
  EXPECT_EQ(narrow.interval, 4);
  EXPECT_EQ(narrow.line_interval, 8);
  EXPECT_EQ(narrow.least_latency, 60);
}

TEST(MemoryPort, SaysWhatIsAllowed) {
  const TemporaryFolder folder;
  const auto refusal = [](const std::string& text) {
    return message_of<std::runtime_error>([&] { static_cast<void>(memory_port(text)); });
  };
  const auto refusal_of = [&](const std::string& text) {
    return refusal(folder.write("m.json", text).string());
  };
  std::vector<std::string_view> names;
  for (const KnownMemory& each : known_memories()) names.push_back(each.name);
  EXPECT_EQ(refusal("nothing"),
            fmt::format("memory nothing: there is no memory nothing; allowed is {}, or a JSON file",
                        fmt::join(names, ", ")));
  EXPECT_EQ(refusal("ideal,latency=0"), "memory ideal: latency is 0; allowed is 1 to 10000");
  EXPECT_EQ(refusal("ideal,latency=9..3"),
            "memory ideal: latency is 9..3; allowed is the least, and then the most");
  EXPECT_EQ(refusal("ideal,latency"), "memory ideal: a figure is latency; allowed is FIGURE=N");
  EXPECT_EQ(refusal("ideal,banks=3"), "memory ideal: banks is 3; allowed is a power of two");
  EXPECT_EQ(refusal("ideal,beat_bytes=24"), "memory ideal: beat_bytes is 24; allowed is a power of two");
  EXPECT_EQ(refusal("ideal,rows=2"), "memory ideal: there is no figure rows; allowed is " + figure_names());
  EXPECT_THAT(refusal_of(R"({"latency": [3]})"), testing::HasSubstr("latency: it has not two numbers"));
  EXPECT_THAT(refusal_of(R"({"rows": 3})"), testing::HasSubstr("rows"));
  EXPECT_THAT(refusal_of(R"({"refused_percent": 100})"),
              testing::HasSubstr("refused_percent is 100; allowed is 0 to 99"));
}

}  // namespace
}  // namespace hitpipe::sim::memory_port_test
