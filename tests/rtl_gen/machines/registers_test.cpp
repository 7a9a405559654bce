// The registers of a core, as a host writes and reads them by AXI4-Lite.
#include "hls/machines/registers.hpp"

#include <array>
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
    const Word address = static_cast<Word>(4 * hls::registers::at<"CYCLES"> + 8 * number);
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
  EXPECT_EQ(read(0x04), 3U);
  EXPECT_EQ(read(0x1c), 0xfffffU) << "as many steps as a ray can count";
  EXPECT_EQ(read(0x20), 0U) << "no ray begins";
  for (const Order order : {Order::together, Order::address_first, Order::word_first}) {
    const Word change = order == Order::together ? 0U : order == Order::address_first ? 0x40U : 0x80U;
    write(0x10, 0x87654321U ^ change, order);
    write(0x14, 0xfedcba98U, order);
    write(0x18, 0x000bcdefU ^ change, order);
    write(0x1c, 0x00054321U ^ change, order);
    write(0x20, 0x00000055U, order);
    EXPECT_EQ(read(0x10), (0x87654321U ^ change) & ~63U) << "a multiple of 64";
    EXPECT_EQ(read(0x14), 0x98U) << "of 40 bits";
    EXPECT_EQ(read(0x18), (0xbcdefU ^ change)) << "of 20 bits";
    EXPECT_EQ(read(0x1c), 0x54321U ^ change);
    EXPECT_EQ(read(0x20), 0x55U) << "of 7 bits";
    EXPECT_EQ(registers_.out["base"], (Word{0x9887654321U} ^ change) >> 6);
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
  for (const Word address : {0x0cU, 0x24U, 0x34U, 0x3cU, 0x80U, 0xfcU}) EXPECT_EQ(read(address), 0U);
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
  for (const Word why : {1U, 2U, 4U}) {
    registers_.in["hit_failed"] = why;
    happens({"hit_valid", "hit_ready"}, 7, 0, 3);
  }
  registers_.in["hit_failed"] = 0;
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

TEST_F(CoreRegisters, SayWhatTheCoreIs) {
  registers_.in["about_format"] = 0x0b141214;
  registers_.in["about_shape"] = 0x183c0020;
  registers_.in["about_ports"] = 0x02202010;
  registers_.in["about_limits"] = 0x10cd8a20;
  EXPECT_EQ(read(0x28), 0x0b141214U);
  EXPECT_EQ(read(0x2c), 0x183c0020U);
  EXPECT_EQ(read(0x30), 0x02202010U);
  EXPECT_EQ(read(0x38), 0x10cd8a20U);
  write(0x28, 0);
  EXPECT_EQ(read(0x28), 0x0b141214U);
}

TEST_F(CoreRegisters, KeepWhatWentWrong) {
  constexpr Word idle = 1;
  EXPECT_EQ(read(0x08), idle);
  const auto answer = [&](Word why) {
    registers_.in["ray_valid"] = registers_.in["ray_ready"] = 1;
    cycle();
    registers_.in["ray_valid"] = 0;
    registers_.in["hit_valid"] = registers_.in["hit_ready"] = 1;
    registers_.in["hit_failed"] = why;
    cycle();
    registers_.in["hit_valid"] = registers_.in["hit_failed"] = 0;
  };
  answer(0);
  EXPECT_EQ(read(0x08), idle);
  Word seen = idle;
  for (Word why = 1; why <= 5; ++why) {
    answer(why);
    seen |= Word{1} << (8 + why);
    EXPECT_EQ(read(0x08), seen);
  }
  registers_.in["read_error"] = 1;
  cycle();
  EXPECT_EQ(read(0x08), seen) << "no block comes";
  registers_.in["request_valid"] = registers_.in["request_ready"] = 1;
  cycle();
  registers_.in["request_valid"] = 0;
  registers_.in["read_valid"] = 1;
  cycle();
  registers_.in["read_valid"] = registers_.in["read_error"] = 0;
  EXPECT_EQ(read(0x08), seen |= 1U << 14);
  write(0x10, 0x12345600);
  write(0x10, 0x123456ff, Order::together, 2);
  write(0x18, 0x3f);
  EXPECT_EQ(read(0x08), seen);
  write(0x10, 0x12345620);
  EXPECT_EQ(read(0x08), seen |= 1U << 15);
  write(0x08, 0x2000);
  EXPECT_EQ(read(0x08), seen & ~Word{0x2000});
  write(0x08, 0xffffffff, Order::together, 1);
  EXPECT_EQ(read(0x08), seen & ~Word{0x2000}) << "bytes without a strobe stay";
  write(0x08, 0xffffffff);
  EXPECT_EQ(read(0x08), idle);
}

TEST_F(CoreRegisters, TakeNoRayWhileNoneMayBegin) {
  EXPECT_EQ(registers_.out["lets_rays"], 0U) << "after a hard reset";
  write(0x20, 1);
  EXPECT_EQ(registers_.out["lets_rays"], 1U);
  write(0x0c, 1);
  for (int i = 0; i < 10; ++i) cycle();
  EXPECT_EQ(read(0x08), 1U);
  EXPECT_EQ(registers_.out["lets_rays"], 0U) << "after a soft reset";
}

TEST_F(CoreRegisters, KnowWhetherARayIsThere) {
  registers_.in["ray_valid"] = registers_.in["ray_ready"] = 1;
  for (int i = 0; i < 70; ++i) cycle();
  registers_.in["hit_valid"] = registers_.in["hit_ready"] = 1;
  for (int i = 0; i < 100; ++i) cycle();  // one comes, and one leaves
  registers_.in["ray_valid"] = 0;
  for (int i = 0; i < 69; ++i) cycle();
  registers_.in["hit_valid"] = 0;
  EXPECT_EQ(read(0x08), 0U);
  registers_.in["hit_valid"] = 1;
  cycle();
  registers_.in["hit_valid"] = 0;
  EXPECT_EQ(read(0x08), 1U);
}

/// What is offered stays until it is taken, and what was asked for comes home. Nothing else passes.
TEST_F(CoreRegisters, ResetTheCoreWhenReadsAreHome) {
  const auto passes = [&] {
    return std::array{registers_.out["lets_rays"], registers_.out["lets_requests"],
                      registers_.out["lets_answers"], registers_.out["resets"]};
  };
  using Passes = std::array<Word, 4>;
  write(0x20, 8);
  registers_.in["ray_valid"] = registers_.in["ray_ready"] = 1;
  for (int i = 0; i < 3; ++i) cycle();
  registers_.in["ray_valid"] = 0;
  registers_.in["request_valid"] = registers_.in["request_ready"] = 1;
  for (int i = 0; i < 2; ++i) cycle();
  registers_.in["request_ready"] = 0;  // a third one is offered, and an answer
  registers_.in["hit_valid"] = 1;
  write(0x0c, 0xfffffffe);
  EXPECT_EQ(passes(), (Passes{1, 1, 1, 0}));
  write(0x0c, 1);
  EXPECT_EQ(passes(), (Passes{0, 1, 1, 0}));
  EXPECT_EQ(read(0x08), 2U) << "not idle, but resetting";
  EXPECT_EQ(read(0x20), 0U) << "no ray begins until software says so";
  write(0x20, 8);
  EXPECT_EQ(read(0x20), 0U);
  for (int i = 0; i < 5; ++i) cycle();
  EXPECT_EQ(passes(), (Passes{0, 1, 1, 0}));
  registers_.in["hit_ready"] = 1;
  cycle();
  EXPECT_EQ(passes(), (Passes{0, 1, 0, 0}));
  registers_.in["hit_ready"] = registers_.in["hit_valid"] = 0;
  registers_.in["request_ready"] = 1;
  cycle();
  EXPECT_EQ(passes(), (Passes{0, 0, 0, 0}));
  registers_.in["request_valid"] = registers_.in["request_ready"] = 0;
  for (int block = 0; block < 3; ++block) {
    for (int i = 0; i < 5; ++i) cycle();
    EXPECT_EQ(passes(), (Passes{0, 0, 0, 0})) << block;
    registers_.in["read_valid"] = 1;
    cycle();
    registers_.in["read_valid"] = 0;
  }
  EXPECT_EQ(passes(), (Passes{0, 0, 0, 0}));
  cycle();
  EXPECT_EQ(passes(), (Passes{0, 0, 0, 1})) << "the core is reset";
  cycle();
  EXPECT_EQ(passes(), (Passes{0, 1, 1, 0})) << "no ray may begin yet";
  EXPECT_EQ(read(0x08), 1U) << "idle: its rays are gone";
  write(0x20, 8);
  EXPECT_EQ(passes(), (Passes{1, 1, 1, 0}));
  EXPECT_EQ(registers_.out["most_rays"], 8U);
  write(0x0c, 1);
  EXPECT_EQ(read(0x20), 0U) << "nothing was on its way";
  EXPECT_EQ(passes(), (Passes{0, 1, 1, 0}));
}

}  // namespace
}  // namespace hitpipe::rtl::registers_test
