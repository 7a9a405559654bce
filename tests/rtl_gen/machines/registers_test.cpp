// The registers of a core, as a host writes and reads them by AXI4-Lite.
#include "hls/machines/registers.hpp"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::rtl::registers_test {
namespace {

class CoreRegisters : public testing::Test {
 protected:
  void SetUp() override { registers_.give(); }

  enum class Order { together, address_first, word_first };

  void write(Word address, Word word, Order order = Order::together, Word strobes = 15) {
    registers_.in["awaddr"] = address;
    registers_.in["wdata"] = word;
    registers_.in["wstrb"] = strobes;
    registers_.in["awvalid"] = order != Order::word_first;
    registers_.in["wvalid"] = order != Order::address_first;
    ASSERT_TRUE(registers_.out["awready"] && registers_.out["wready"]);
    cycle();
    if (order != Order::together) {
      // What waits for the other is kept.
      for (const char* const port :
           order == Order::word_first ? std::vector{"wdata", "wstrb"} : std::vector{"awaddr"})
        registers_.in[port] ^= 15;
      registers_.in["awvalid"] = registers_.in["wvalid"] = 0;
      for (int i = 0; i < 3; ++i) {
        ASSERT_EQ(registers_.out["bvalid"], 0U);
        cycle();
      }
      registers_.in["awvalid"] = order == Order::word_first;
      registers_.in["wvalid"] = order == Order::address_first;
      cycle();
    }
    registers_.in["awvalid"] = registers_.in["wvalid"] = 0;
    cycle();
    ASSERT_EQ(registers_.out["bvalid"], 1U);
    cycle();
    ASSERT_EQ(registers_.out["bvalid"], 1U) << "it is held until it is taken";
    registers_.in["bready"] = 1;
    cycle();
    registers_.in["bready"] = 0;
    ASSERT_EQ(registers_.out["bvalid"], 0U);
  }
  std::uint64_t read(Word address) {
    registers_.in["araddr"] = address;
    registers_.in["arvalid"] = 1;
    cycle();
    registers_.in["arvalid"] = 0;
    cycle();
    EXPECT_EQ(registers_.out["rvalid"], 1U);
    const auto word = static_cast<std::uint64_t>(registers_.out["rdata"]);
    cycle();
    EXPECT_EQ(registers_.out["rvalid"], 1U) << "it is held until it is taken";
    EXPECT_EQ(registers_.out["rdata"], word);
    registers_.in["rready"] = 1;
    cycle();
    registers_.in["rready"] = 0;
    EXPECT_EQ(registers_.out["rvalid"], 0U);
    return word;
  }
  std::uint64_t counter(int number) {
    const Word address = static_cast<Word>(4 * hls::registers::counters_at + 8 * number);
    const std::uint64_t low = read(address);
    return low | read(address + 4) << 32;
  }

  void cycle() {
    registers_.step();
    registers_.give();
  }

  NamedMachine registers_{"registers", hls::RegisterBits{20, 40, 6, 36}};
};

TEST_F(CoreRegisters, KeepWhatIsWritten) {
  EXPECT_EQ(read(0x00), 0x48697470U);
  EXPECT_EQ(read(0x04), 1U);
  EXPECT_EQ(read(0x1c), 0xfffffU) << "as many steps as a ray can count";
  EXPECT_EQ(read(0x20), 0U) << "no ray begins";
  for (const Order order : {Order::together, Order::address_first, Order::word_first}) {
    const Word change = order == Order::together ? 0U : order == Order::address_first ? 0x10U : 0x20U;
    write(0x10, 0x87654321U ^ change, order);
    write(0x14, 0xfedcba98U, order);
    write(0x18, 0x000bcdefU ^ change, order);
    write(0x1c, 0x00054321U ^ change, order);
    write(0x20, 0x00000055U, order);
    EXPECT_EQ(read(0x10), (0x87654321U ^ change) & ~31U) << "a multiple of 32";
    EXPECT_EQ(read(0x14), 0x98U) << "of 40 bits";
    EXPECT_EQ(read(0x18), (0xbcdefU ^ change)) << "of 20 bits";
    EXPECT_EQ(read(0x1c), 0x54321U ^ change);
    EXPECT_EQ(read(0x20), 0x55U) << "of 7 bits";
    EXPECT_EQ(registers_.out["base"], (Word{0x9887654321U} ^ change) >> 5);
    EXPECT_EQ(registers_.out["last"], 0xbcdefU ^ change);
    EXPECT_EQ(registers_.out["most_steps"], 0x54321U ^ change);
    EXPECT_EQ(registers_.out["most_rays"], 0x55U);
  }
}

TEST_F(CoreRegisters, TakeSingleBytesAndOnlyWhatTheyHave) {
  write(0x18, 0x12345);
  write(0x18, 0xffffff99, Order::together, 1);
  EXPECT_EQ(read(0x18), 0x12399U);
  write(0x18, 0xffff77ff, Order::together, 2);
  EXPECT_EQ(read(0x18), 0x17799U);
  write(0x00, 5);
  EXPECT_EQ(read(0x00), 0x48697470U);
  for (const Word address : {0x08U, 0x0cU, 0x24U, 0x28U, 0x3cU, 0x80U, 0xfcU}) EXPECT_EQ(read(address), 0U);
  EXPECT_EQ(read(0x1b), 0x17799U) << "two low bits of an address are ignored";
}

TEST_F(CoreRegisters, TakeTheLargestForWhatIsTooLarge) {
  for (const Word large : {0x100000U, 0x80000000U, 0xffffffffU}) {
    write(0x18, large);
    EXPECT_EQ(read(0x18), 0xfffffU);
    write(0x1c, 5);
    write(0x1c, large);
    EXPECT_EQ(read(0x1c), 0xfffffU);
    write(0x20, 5);
    write(0x20, large);
    EXPECT_EQ(read(0x20), 0x7fU);
    EXPECT_EQ(registers_.out["most_rays"], 0x7fU);
  }
  write(0x20, 0x80);
  EXPECT_EQ(read(0x20), 0x7fU) << "the first that is too large";
  write(0x20, 0x7f);
  EXPECT_EQ(read(0x20), 0x7fU);
  write(0x1c, 0x10, Order::together, 4);
  EXPECT_EQ(read(0x1c), 0xffffU) << "bytes without a strobe stay";
}

TEST_F(CoreRegisters, HoldAnAnswerWhileTheNextIsWanted) {
  write(0x18, 0x12345);
  registers_.in["arvalid"] = 1;
  registers_.in["araddr"] = 0x18;
  cycle();
  registers_.in["araddr"] = 0x00;
  for (int i = 0; i < 4; ++i) cycle();
  registers_.in["arvalid"] = 0;
  EXPECT_EQ(registers_.out["rdata"], 0x12345U);
  registers_.in["rready"] = 1;
  cycle();
  EXPECT_EQ(registers_.out["rvalid"], 1U);
  EXPECT_EQ(registers_.out["rdata"], 0x48697470U);
  cycle();
  EXPECT_EQ(registers_.out["rvalid"], 0U);

  registers_.in["awvalid"] = registers_.in["wvalid"] = 1;
  registers_.in["awaddr"] = 0x18;
  registers_.in["wstrb"] = 15;
  registers_.in["wdata"] = 1;
  cycle();
  cycle();
  registers_.in["wdata"] = 2;
  cycle();
  registers_.in["awvalid"] = registers_.in["wvalid"] = 0;
  for (int i = 0; i < 4; ++i) cycle();
  EXPECT_EQ(registers_.out["bvalid"], 1U);
  EXPECT_EQ(registers_.out["last"], 1U) << "the second write waits for the first one's answer";
  registers_.in["bready"] = 1;
  cycle();
  registers_.in["bready"] = 0;
  cycle();
  EXPECT_EQ(registers_.out["bvalid"], 1U);
  EXPECT_EQ(registers_.out["last"], 2U);
}

TEST_F(CoreRegisters, CountWhatHappens) {
  enum { cycles, rays, answers, hits, records, triangles, idle, refused };
  write(0x24, 0);
  const std::uint64_t before = counter(cycles), idle_before = counter(idle);
  EXPECT_LT(before, 20U);
  const auto happens = [&](const std::vector<const char*>& ports, Word number, Word id, int times) {
    for (const char* const port : ports) registers_.in[port] = 1;
    registers_.in["hit_number"] = number;
    registers_.in["request_id"] = id;
    for (int i = 0; i < times; ++i) cycle();
    for (const char* const port : ports) registers_.in[port] = 0;
  };
  const Word none = ones_below(32), triangle = 1U << 6;
  happens({"ray_valid"}, 0, 0, 3);
  happens({"ray_valid", "ray_ready"}, 0, 0, 5);
  happens({"hit_ready"}, 0, 0, 3);
  happens({"hit_valid", "hit_ready"}, 7, 0, 11);
  happens({"hit_valid", "hit_ready"}, none, 0, 13);
  happens({"hit_valid", "hit_ready", "hit_failed"}, 7, 0, 9);
  happens({"request_valid", "request_ready"}, 0, 5, 17);
  happens({"request_valid", "request_ready"}, 0, triangle | 5, 19);
  happens({"request_valid"}, 0, triangle, 23);
  EXPECT_EQ(counter(rays), 5U);
  EXPECT_EQ(counter(answers), 33U);
  EXPECT_EQ(counter(hits), 11U) << "an answer that has failed is no hit";
  EXPECT_EQ(counter(records), 17U);
  EXPECT_EQ(counter(triangles), 19U);
  EXPECT_EQ(counter(refused), 23U);
  const std::uint64_t after = counter(cycles), idle_after = counter(idle);
  EXPECT_GE(after - before, 94U);
  // Both differences are of the same two moments.
  EXPECT_EQ(after - before, idle_after - idle_before + 17 + 19 + 23);
  write(0x24, 1);
  EXPECT_EQ(counter(hits), 0U);
}

}  // namespace
}  // namespace hitpipe::rtl::registers_test
