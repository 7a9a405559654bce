// Which registers lie in the multiplier blocks of a chip.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/schedule/registers.hpp"

namespace hitpipe::rtl::block_registers_test {
namespace {

/// (a - c) * b, of which only bits 20:8 leave the unit; `b` also leaves it if asked.
Graph scaled_difference(bool is_signed, bool b_leaves) {
  Graph g("toy");
  const NodeId a = g.input("a", 12, true);
  const NodeId b = g.input("b", 12, true);
  const NodeId c = g.input("c", 12, true);
  const NodeId difference = g.binary(Op::sub, a, c);
  g.annotate(difference, "difference", {});
  const NodeId product = g.binary(Op::mul, difference, b, is_signed);
  g.annotate(product, "product", {});
  g.output("p", g.slice(product, 20, 8));
  if (b_leaves) g.output("same", b);
  return g;
}

std::string registers(const Graph& graph, const char* library) {
  const Pipeline pipeline = make_pipeline(graph, library_called(library));
  std::string text;
  for (const Register& r : pipeline.placement.registers) {
    text += fmt::format("{}{}: {}[{}:{}]{}", text.empty() ? "" : ", ", r.boundary,
                        pipeline.graph[r.value].name, r.high, r.low, r.in_block ? " in block" : "");
    if (r.unread != 0) text += fmt::format(" unread {:x}", r.unread);
  }
  return text;
}

TEST(BlockRegisters, OperandsAndProductAreInTheBlock) {
  EXPECT_EQ(registers(scaled_difference(true, false), "ice40_up5k"),
            "0: a[11:0], 0: b[11:0], 0: c[11:0], 1: b[11:0] in block, 1: difference[11:0] in block, "
            "2: product[20:0] in block unread ff");
}

TEST(BlockRegisters, AnOperandThatOthersReadStaysOutside) {
  EXPECT_EQ(registers(scaled_difference(true, true), "ice40_up5k"),
            "0: a[11:0], 0: b[11:0], 0: c[11:0], 1: b[11:0], 1: difference[11:0] in block, "
            "2: b[11:0], 2: product[20:0] in block unread ff");
}

/// Its reader works before the register, in the stage that ends with it.
TEST(BlockRegisters, ASignThatIsReadBeforeTheRegisterKeepsNothingOutside) {
  Graph g("toy");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 8, true);
  const NodeId difference = g.binary(Op::sub, a, b);
  g.annotate(difference, "difference", {});
  const NodeId other = g.binary(Op::bit_and, g.extend(g.slice(difference, 7, 7), 8, true), b);
  g.annotate(other, "other", {});
  const NodeId product = g.binary(Op::mul, difference, other, true);
  g.annotate(product, "product", {});
  g.output("p", product);
  EXPECT_EQ(registers(g, "ice40_up5k"),
            "0: a[7:0], 0: b[7:0], 1: difference[7:0] in block, 1: other[7:0] in block, "
            "2: product[15:0] in block");
}

/// A block that multiplies signed operands alone gets a zero above them, which is no register's.
TEST(BlockRegisters, UnsignedOperandsStayOutsideASignedBlock) {
  EXPECT_EQ(registers(scaled_difference(false, false), "xc7"),
            "0: a[11:0], 0: b[11:0], 0: c[11:0], 1: b[11:0], 1: difference[11:0], "
            "3: product[20:0] in block unread ff");
}

TEST(BlockRegisters, ABlockWithoutThemLeavesAllOutside) {
  EXPECT_EQ(registers(scaled_difference(true, false), "ecp5"),
            "0: a[11:0], 0: b[11:0], 0: c[11:0], 1: b[11:0], 1: difference[11:0], 2: product[20:8]");
}

/// They lie behind or before a multiplexer, or several read the product.
TEST(BlockRegisters, TheRegistersAroundASharedBlockStayOutside) {
  Graph g("toy");
  for (const std::string i : {"0", "1"}) {
    const NodeId product = g.binary(Op::mul, g.input("a" + i, 16, true), g.input("b" + i, 16, true), true);
    g.annotate(product, "product" + i, {});
    g.output("p" + i, product);
  }
  const Pipeline pipeline = make_pipeline(g, library_called("ice40_up5k"), std::nullopt, 2);
  EXPECT_EQ(pipeline.binding.instance_of.size(), 2U);
  for (const Register& r : pipeline.placement.registers) EXPECT_FALSE(r.in_block) << r.boundary;
}

}  // namespace
}  // namespace hitpipe::rtl::block_registers_test
