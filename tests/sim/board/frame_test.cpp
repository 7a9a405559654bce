// Frames and packed bits: the bytes that docs/chips.md shows, and what becomes of damaged frames.
#include "sim/board/frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::sim::frame_test {
namespace {

using namespace std::string_literals;

std::vector<std::string> taken(FrameReader& reader, const std::string& bytes) {
  std::vector<std::string> payloads;
  for (const char byte : bytes)
    if (auto payload = reader.take(byte)) payloads.push_back(*payload);
  return payloads;
}

TEST(Frame, HasTheCheckSequenceOfRfc1662) {
  // CRC-16/X-25 of "123456789" is 0x906e.
  EXPECT_EQ(to_frame("123456789"), "\x7e"s + "123456789" + "\x6e\x90\x7e");
  EXPECT_EQ(to_frame("I?"), "\x7eI?MW\x7e");
}

/// The check sequence as RFC 1662 describes it and as the board's Verilog computes it, bit by bit.
unsigned check_sequence(const std::string& bytes) {
  unsigned check = 0xffff;
  for (const char byte : bytes) {
    check ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) check = (check & 1U) != 0 ? (check >> 1) ^ 0x8408U : check >> 1;
  }
  return check ^ 0xffffU;
}

TEST(Frame, EndsInTheCheckSequenceOfEveryPayload) {
  std::string payload;
  for (int byte = 0; byte < 600; ++byte) {
    const unsigned check = check_sequence(payload);
    std::string expected = "\x7e"s;
    for (const char each : payload + static_cast<char>(check & 0xffU) + static_cast<char>(check >> 8)) {
      if (each == '\x7e' || each == '\x7d') {
        expected += '\x7d';
        expected += static_cast<char>(each ^ 0x20);
      } else {
        expected += each;
      }
    }
    EXPECT_EQ(to_frame(payload), expected + "\x7e") << byte << " bytes";
    payload += static_cast<char>(byte * 7);
  }
}

TEST(Frame, EscapesFlagsAndEscapes) {
  EXPECT_THAT(to_frame("\x7e\x7d"), testing::StartsWith("\x7e\x7d\x5e\x7d\x5d"));
}

TEST(Frame, EveryPayloadComesBack) {
  FrameReader reader;
  std::string payload;
  for (int byte = 0; byte < 600; ++byte) {
    EXPECT_EQ(taken(reader, to_frame(payload)), std::vector<std::string>{payload});
    payload += static_cast<char>(byte * 7);
  }
  EXPECT_EQ(reader.damaged(), 0U);
}

TEST(Frame, ALostOrChangedByteSpoilsOnlyItsFrame) {
  const std::string first = to_frame("T\x01 one");
  const std::string second = to_frame("T\x02 two");
  for (std::size_t i = 1; i + 1 < first.size(); ++i) {
    FrameReader reader;
    std::string lost = first;
    lost.erase(i, 1);
    EXPECT_EQ(taken(reader, lost + second), std::vector<std::string>{"T\x02 two"}) << i;
    std::string changed = first;
    changed[i] = static_cast<char>(changed[i] ^ 4);
    EXPECT_EQ(taken(reader, changed + second), std::vector<std::string>{"T\x02 two"}) << i;
    EXPECT_EQ(reader.damaged(), 2U) << i;
  }
}

TEST(PackedBits, LieInPortOrderFromTheLowBits) {
  const std::vector<rtl::Port> ports{{"a", 4, true}, {"b", 1, false}, {"c", 12, true}, {"d", 3, false}};
  const std::vector<std::int64_t> values{-3, 1, -2, 5};
  // a = 1101, b = 1, c = 111111111110, d = 101, from the right: 0000 101 111111111110 1 1101.
  EXPECT_EQ(pack(ports, values), "\xdd\xff\x0b");
  EXPECT_EQ(unpack(ports, pack(ports, values)), values);
}

TEST(PackedBits, HoldTheWidestPorts) {
  const std::vector<rtl::Port> ports{{"a", 1, false}, {"b", 64, true}, {"c", 63, false}};
  const std::vector<std::int64_t> values{1, -2, std::numeric_limits<std::int64_t>::max()};
  EXPECT_EQ(pack(ports, values).size(), 16U);
  EXPECT_EQ(unpack(ports, pack(ports, values)), values);
}

}  // namespace
}  // namespace hitpipe::sim::frame_test
