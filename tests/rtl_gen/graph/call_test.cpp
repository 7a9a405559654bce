// Calls: a component with a graph of its own inside, and how passes treat it.
#include <array>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/sources.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::call_test {
namespace {

/// 4-bit a - 2 b.
std::shared_ptr<const Unit> less_twice(const std::string& name = "less_twice") {
  Graph body(name);
  const NodeId a = body.input("a", 4, false);
  const NodeId b = body.input("b", 3, false);
  body.output("r", body.binary(Op::sub, a, body.concat(b, body.constant(1, 0))));
  return std::make_shared<const Unit>(Unit{"int_subtract", 4, body});
}

TEST(Call, HasTheValueOfItsBody) {
  Graph g("caller");
  const std::array<NodeId, 2> operands{g.input("x", 4, false), g.input("y", 3, false)};
  g.output("o", g.invert(g.call(less_twice(), operands)));
  for (std::uint64_t x = 0; x < 16; ++x) {
    for (std::uint64_t y = 0; y < 8; ++y) {
      const std::array<std::uint64_t, 2> in{x, y};
      EXPECT_EQ(evaluate(g, in).front(), ~(x - 2 * y) & 15U) << x << ' ' << y;
    }
  }
}

TEST(Call, ToTheSameUnitWithTheSameOperandsIsOneNode) {
  Graph g("caller");
  const NodeId x = g.input("x", 4, false);
  const NodeId y = g.input("y", 3, false);
  const NodeId first = g.call(less_twice(), std::array{x, y});
  EXPECT_EQ(g.call(less_twice(), std::array{x, y}), first) << "an equal unit of the same name is the same";
  EXPECT_NE(g.call(less_twice(), std::array{x, g.slice(x, 2, 0)}), first);
  EXPECT_NE(g.call(less_twice("other"), std::array{x, y}), first);
  ASSERT_EQ(g.units().size(), 2U);
  EXPECT_EQ(g.unit_of(first)->body.name(), "less_twice");
}

TEST(Call, ToADifferentUnitOfTheSameNameIsRejected) {
  Graph g("caller");
  const NodeId x = g.input("x", 4, false);
  const NodeId y = g.input("y", 3, false);
  const std::array operands{x, y};
  g.call(less_twice(), operands);
  const auto said = [&](const std::shared_ptr<const Unit>& unit) {
    return message_of<std::invalid_argument>([&] { g.call(unit, operands); });
  };
  const std::string rejected = "graph caller: two different units have the name less_twice";

  Graph more("less_twice");
  const NodeId a = more.input("a", 4, false);
  const NodeId b = more.input("b", 3, false);
  more.output("r", more.binary(Op::add, a, more.concat(b, more.constant(1, 0))));
  EXPECT_EQ(said(std::make_shared<const Unit>(Unit{"int_subtract", 4, more})), rejected) << "another body";
  EXPECT_EQ(said(std::make_shared<const Unit>(Unit{"fp_subtract", 4, less_twice()->body})), rejected)
      << "another component";
  EXPECT_EQ(said(std::make_shared<const Unit>(Unit{"int_subtract", 5, less_twice()->body})), rejected)
      << "another width";
  EXPECT_EQ(said(less_twice()), "no exception") << "the same, traced again";
  EXPECT_EQ(g.units().size(), 1U);
}

TEST(Call, PrintsItsUnitBelow) {
  Graph g("caller");
  const NodeId x = g.input("x", 4, false);
  const NodeId made = g.call(less_twice(), std::array{x, g.slice(x, 3, 1)});
  g.annotate(made, "made", {"here.hpp", 3});
  g.output("o", made);
  EXPECT_EQ(to_text(g),
            "graph caller\n"
            "%0 = input:4  x\n"
            "%1 = slice:3 %0 [3:1]\n"
            "%2 = call:4 %0 %1 less_twice  made @ here.hpp:3\n"
            "output o %2\n"
            "graph less_twice\n"
            "%0 = input:4  a\n"
            "%1 = input:3  b\n"
            "%2 = const:1 0x0\n"
            "%3 = concat:4 %1 %2\n"
            "%4 = sub:4 %0 %3\n"
            "output r %4\n");
}

TEST(Call, CanonicalKeepsLiveUnitsAndWholeOperands) {
  Graph g("caller");
  const NodeId x = g.input("x", 4, false);
  const NodeId y = g.input("y", 3, false);
  g.call(less_twice("dead"), std::array{x, y});
  const NodeId sum = g.binary(Op::add, x, x);
  g.output("o", g.slice(g.call(less_twice("live"), std::array{sum, y}), 0, 0));
  const Graph made = canonical(g);
  ASSERT_EQ(made.units().size(), 1U);
  EXPECT_EQ(made.units().front()->body.name(), "live");
  EXPECT_NE(to_text(made).find("add:4"), std::string::npos)
      << "one bit is read, all of the operand is needed";
  EXPECT_EQ(to_text(canonical(made)), to_text(made));
}

TEST(Call, IsTheSourceOfItsBits) {
  Graph g("caller");
  const NodeId x = g.input("x", 4, false);
  const NodeId made = g.call(less_twice(), std::array{x, g.slice(x, 2, 0)});
  int sources = 0;
  for_each_source_of(g, g.slice(made, 2, 1), [&](NodeId source, std::uint64_t bits) {
    EXPECT_EQ(source, made);
    EXPECT_EQ(bits, 6U);
    ++sources;
  });
  EXPECT_EQ(sources, 1);
}

TEST(Call, WrongOperandsRejected) {
  Graph g("caller");
  const NodeId x = g.input("x", 4, false);
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              g.call(less_twice(), std::array{x, x});
            }),
            "graph caller: operand 1 of less_twice has 4 bits, not 3");
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { g.call(less_twice(), std::array{x}); }),
      "graph caller: less_twice takes 2 operands and gives 1 results, a call has 1 to 3 and 1; here are 1");
}

}  // namespace
}  // namespace hitpipe::rtl::call_test
