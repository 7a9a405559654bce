// The bits that a node reads from values, seen through wires.
#include "rtl_gen/graph/sources.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace hitpipe::rtl::sources_test {
namespace {

using Sources = std::vector<std::pair<NodeId, std::uint64_t>>;

struct ReadWords {
  Graph g{"words"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, false);

  [[nodiscard]] Sources of(NodeId value, std::uint64_t bits) const {
    Sources found;
    for_each_source_of(g, value, bits,
                       [&](NodeId source, std::uint64_t read) { found.emplace_back(source, read); });
    return found;
  }
};

TEST(BitRange, IsAMask) {
  static_assert(bit_range(0, 0) == 1);
  static_assert(bit_range(7, 4) == 0xf0);
  static_assert(bit_range(63, 0) == ~std::uint64_t{0});
  static_assert(bit_range(63, 63) == std::uint64_t{1} << 63);
  EXPECT_EQ(bit_range(62, 1), ~std::uint64_t{0} >> 2 << 1);
}

TEST(Sources, WiresMoveTheBitsThatAreRead) {
  ReadWords w;
  EXPECT_EQ(w.of(w.a, 0x0f), (Sources{{w.a, 0x0f}}));
  EXPECT_EQ(w.of(w.g.slice(w.a, 6, 2), 0x03), (Sources{{w.a, 0x0c}}));
  EXPECT_EQ(w.of(w.g.invert(w.a), 0x81), (Sources{{w.a, 0x81}}));
  const NodeId both = w.g.concat(w.a, w.b);
  EXPECT_EQ(w.of(both, 0x3c0), (Sources{{w.b, 0xc0}, {w.a, 0x03}}));
  EXPECT_EQ(w.of(both, 0x0f), (Sources{{w.b, 0x0f}})) << "nothing of the high half";
  EXPECT_EQ(w.of(both, 0xf00), (Sources{{w.a, 0x0f}})) << "nothing of the low half";
}

TEST(Sources, ASignExtensionReadsTheSign) {
  ReadWords w;
  const NodeId wide = w.g.extend(w.a, 12, true);
  EXPECT_EQ(w.of(wide, 0x00f), (Sources{{w.a, 0x0f}}));
  EXPECT_EQ(w.of(wide, 0x801), (Sources{{w.a, 0x81}})) << "bit 11 is bit 7";
  EXPECT_EQ(w.of(wide, 0x300), (Sources{{w.a, 0x80}}));
}

TEST(Sources, ZerosAndConstantsReadNothing) {
  ReadWords w;
  EXPECT_EQ(w.of(w.g.extend(w.b, 12, false), 0xf00), Sources{});
  EXPECT_EQ(w.of(w.g.extend(w.b, 12, false), 0xf01), (Sources{{w.b, 0x01}}));
  EXPECT_EQ(w.of(w.g.constant(8, 0xff), 0xff), Sources{});
  EXPECT_EQ(w.of(w.a, 0), Sources{});
}

TEST(Sources, OfANodeAreThoseOfItsOperands) {
  ReadWords w;
  const NodeId node = w.g.mux(w.g.slice(w.a, 7, 7), w.g.slice(w.b, 3, 0), w.g.constant(4, 9));
  Sources found;
  for_each_source(w.g, node, [&](NodeId source, std::uint64_t read) { found.emplace_back(source, read); });
  EXPECT_EQ(found, (Sources{{w.a, 0x80}, {w.b, 0x0f}}));
}

}  // namespace
}  // namespace hitpipe::rtl::sources_test
