// Where values are latched: exactly the bits that are read later, as long as they are needed.
#include "rtl_gen/schedule/registers.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/schedule/random_schedule.hpp"

namespace hitpipe::rtl::registers_test {
namespace {

/// "boundary: name[high:low] ...", one line for each boundary with registers.
std::string latched(const Graph& graph, const Placement& placement) {
  std::string text;
  int boundary = -1;
  for (const Register& r : placement.registers) {
    if (r.boundary != boundary) text += fmt::format("{}{}:", boundary < 0 ? "" : "\n", r.boundary);
    boundary = r.boundary;
    text += fmt::format(" {}[{}:{}]", graph[r.value].name, r.high, r.low);
  }
  return text;
}

struct Latched {
  Graph g{"tiny"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, true);

  /// A gate in a stated stage.
  NodeId gate(const char* name, int stage, NodeId x, NodeId y) {
    g.begin_stage(stage);
    const NodeId id = g.binary(Op::bit_and, x, y);
    g.annotate(id, name, {});
    return id;
  }
  [[nodiscard]] std::string registers(Ports ports = Ports::latched) const {
    return latched(g, place_registers(g, schedule_asap(g, unit_library()), ports));
  }
};

TEST(Registers, OnlyBitsThatAreRead) {
  Latched t;
  const NodeId first = t.gate("first", 1, t.a, t.b);
  const NodeId second = t.gate("second", 2, t.g.slice(first, 5, 2), t.g.slice(t.b, 3, 0));
  t.g.output("o", second);
  EXPECT_EQ(t.registers(),
            "0: a[7:0] b[7:0]\n"
            "1: b[3:0] first[5:2]\n"
            "2: second[3:0]");
}

TEST(Registers, ASignIsLatchedAloneOnlyWhereItsWordIsNot) {
  Latched t;
  const NodeId word = t.gate("word", 1, t.a, t.b);
  const NodeId whole = t.gate("whole", 2, word, t.b);
  const NodeId sign = t.gate("sign", 4, t.g.slice(word, 7, 7), t.g.slice(whole, 0, 0));
  t.g.output("o", sign);
  EXPECT_EQ(t.registers(),
            "0: a[7:0] b[7:0]\n"
            "1: b[7:0] word[7:0]\n"
            "2: word[7:7] whole[0:0]\n"
            "3: word[7:7] whole[0:0]\n"
            "4: sign[0:0]");
}

TEST(Registers, AnExtensionsCopiesOfTheSignAreNotLatched) {
  Latched t;
  const NodeId word = t.gate("word", 1, t.a, t.b);
  const NodeId wide = t.g.extend(word, 12, true);
  const NodeId top = t.gate("top", 2, t.g.slice(wide, 11, 6), t.g.constant(6, 0x2a));
  t.g.output("o", top);
  EXPECT_EQ(t.registers(),
            "0: a[7:0] b[7:0]\n"
            "1: word[7:6]\n"
            "2: top[5:0]");
}

TEST(Registers, BitsApartAreRegistersApart) {
  Latched t;
  const NodeId word = t.gate("word", 1, t.a, t.b);
  const NodeId ends = t.g.concat(t.g.slice(word, 7, 6), t.g.slice(word, 1, 0));
  t.g.output("o", t.gate("ends", 2, ends, t.g.slice(word, 4, 1)));
  EXPECT_EQ(t.registers(),
            "0: a[7:0] b[7:0]\n"
            "1: word[4:0] word[7:6]\n"
            "2: ends[3:0]");
  Latched apart;
  const NodeId other = apart.gate("word", 1, apart.a, apart.b);
  const NodeId halves = apart.g.concat(apart.g.slice(other, 7, 6), apart.g.slice(other, 1, 0));
  apart.g.output("o", apart.gate("ends", 2, halves, apart.g.constant(4, 5)));
  EXPECT_EQ(apart.registers(),
            "0: a[7:0] b[7:0]\n"
            "1: word[1:0] word[7:6]\n"
            "2: ends[3:0]");
}

TEST(Registers, NothingThatIsNotReadAndNoConstant) {
  Latched t;
  t.g.input("unread", 8, false);
  t.g.output("o", t.gate("low", 1, t.g.slice(t.a, 2, 0), t.g.constant(3, 6)));
  t.g.output("one", t.g.constant(1, 1));
  EXPECT_EQ(t.registers(),
            "0: a[2:0]\n"
            "1: low[2:0]");
}

TEST(Registers, AnOutputIsLatchedOnceBehindTheLastStage) {
  Latched t;
  const NodeId early = t.gate("early", 1, t.a, t.b);
  t.g.output("early", early);
  t.g.output("early_inverted", t.g.invert(early));
  t.g.output("late", t.gate("late", 3, t.g.slice(t.a, 0, 0), t.g.slice(t.b, 0, 0)));
  t.g.output("port", t.g.slice(t.a, 1, 0));
  EXPECT_EQ(t.registers(),
            "0: a[7:0] b[7:0]\n"
            "1: a[1:0] b[0:0] early[7:0]\n"
            "2: a[1:0] b[0:0] early[7:0]\n"
            "3: a[1:0] early[7:0] late[0:0]");
}

TEST(Registers, InsideAComponentPortsAreNotLatched) {
  Latched t;
  const NodeId first = t.gate("first", 1, t.a, t.b);
  t.g.output("o", t.gate("second", 2, first, t.b));
  EXPECT_EQ(t.registers(Ports::direct), "1: b[7:0] first[7:0]");
}

/// One bit of a value that can be latched. no_node for a constant bit.
using Bit = std::pair<NodeId, int>;

Bit source_bit(const Graph& graph, NodeId value, int bit) {
  const Node& n = graph[value];
  const auto width = [&](std::size_t i) { return graph[n.args[i]].width; };
  switch (n.op) {
    case Op::constant:
      return {no_node, 0};
    case Op::slice:
      return source_bit(graph, n.args[0], bit + n.low);
    case Op::invert:
      return source_bit(graph, n.args[0], bit);
    case Op::concat:
      return bit < width(1) ? source_bit(graph, n.args[1], bit)
                            : source_bit(graph, n.args[0], bit - width(1));
    case Op::extend:
      if (bit >= width(0) && !n.is_signed) return {no_node, 0};
      return source_bit(graph, n.args[0], std::min(bit, width(0) - 1));
    default:
      return {value, bit};
  }
}

using LatchedBit = std::tuple<int, NodeId, int>;  ///< boundary, value, bit

struct Needed {
  std::set<LatchedBit> latched;
  std::set<LatchedBit> held;  ///< read later than in the next stage
  std::set<Bit> read;
};

/// From the definition, bit by bit: a bit read in a stage is latched since it was computed, at every boundary
/// whose distance is a multiple of the interval.
Needed needed(const Graph& graph, const Schedule& schedule, Ports ports, int interval) {
  Needed bits;
  const auto use = [&](NodeId value, int stage) {
    for (int i = 0; i < graph[value].width; ++i) {
      const Bit bit = source_bit(graph, value, i);
      if (bit.first == no_node) continue;
      bits.read.insert(bit);
      const bool port = graph[bit.first].op == Op::input;
      const int from = port ? (ports == Ports::latched ? 0 : 1) : schedule.slots[bit.first].finish;
      for (int b = from; b < stage; ++b) {
        if ((b - from) % interval != 0) continue;
        bits.latched.emplace(b, bit.first, bit.second);
        if (interval > 1 && b + 1 < stage) bits.held.emplace(b, bit.first, bit.second);
      }
    }
  };
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (!is_root(graph[id].op)) continue;
    for (const NodeId arg : graph[id].operands()) use(arg, schedule.slots[id].stage);
  }
  for (const Output& out : graph.outputs())
    use(out.node, schedule.stages + (ports == Ports::latched ? 1 : 0));
  return bits;
}

TEST(Registers, RandomSchedulesLatchEveryBitThatIsReadLaterAndNoOther) {
  constexpr int graphs = 300;
  Seeded random(149);
  const Library library = unit_library();
  std::size_t latched_bits = 0;
  int held = 0;
  for (int i = 0; i < graphs; ++i) {
    const Graph graph = canonical(Recipe(random, 5, 40, 4).graph());
    const Schedule schedule = random_schedule(graph, library, schedule_asap(graph, library).clock_ps, random);
    const Ports ports = random.flip() ? Ports::latched : Ports::direct;
    const int interval = 1 + i % 4;
    const Placement placement = place_registers(graph, schedule, ports, {interval, {}});
    const Needed bits = needed(graph, schedule, ports, interval);
    std::set<LatchedBit> placed;
    const Register* before = nullptr;
    for (const Register& r : placement.registers) {
      bool holds = false;
      for (int bit = r.low; bit <= r.high; ++bit) {
        ASSERT_TRUE(placed.emplace(r.boundary, r.value, bit).second) << "latched twice";
        holds |= bits.held.contains({r.boundary, r.value, bit});
      }
      ASSERT_EQ(r.holds(), holds);
      held += holds ? 1 : 0;
      if (before != nullptr) {
        const bool same = before->boundary == r.boundary && before->value == r.value;
        ASSERT_LT(std::tuple(before->boundary, before->value, before->low),
                  std::tuple(r.boundary, r.value, r.low));
        ASSERT_TRUE(!same || before->high + 1 < r.low) << "adjacent bits are one register";
      }
      before = &r;
    }
    ASSERT_EQ(placed, bits.latched) << to_text(graph);
    latched_bits += placed.size();
    for (NodeId id = 0; id < graph.size(); ++id) {
      for (int bit = 0; bit < 64; ++bit) {
        ASSERT_EQ((placement.used_bits[id] >> bit & 1) != 0, bits.read.contains({id, bit}))
            << "%" << id << " bit " << bit;
      }
    }
  }
  EXPECT_GT(latched_bits, static_cast<std::size_t>(graphs) * 50);
  EXPECT_GT(held, graphs);
}

/// Two products on one component of one cycle, each read in the next stage, but the first also in `later`.
Placement of_two_products(int interval, int later) {
  const Library library = unit_library();
  Graph g("two_products");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 8, true);
  const NodeId c = g.input("c", 8, true);
  const auto product = [&](const char* name, NodeId x, NodeId y) {
    const NodeId id = g.binary(Op::mul, x, y, true);
    g.annotate(id, name, {});
    return id;
  };
  const NodeId ab = product("ab", a, b);
  const NodeId ac = product("ac", a, c);
  g.output("first", g.binary(Op::bit_and, ab, g.extend(a, 16, true)));
  const NodeId second = g.binary(Op::bit_and, ac, g.extend(b, 16, true));
  g.output("second", second);
  g.begin_stage(later);
  g.output("late", g.binary(Op::bit_xor, g.slice(ab, 3, 0), g.slice(a, 3, 0)));
  const SharedSchedule s =
      schedule_modulo({.graph = g, .library = library, .interval = interval, .groups = {{{ab, ac}, 1}}});
  Placement placement = place_registers(g, s.schedule, Ports::latched, s.binding);
  std::erase_if(placement.registers, [&](const Register& r) { return r.value != ab && r.value != ac; });
  return placement;
}

TEST(Registers, ResultsOfOneComponentHaveOneRegister) {
  const Placement apart = of_two_products(3, 1);
  ASSERT_EQ(apart.registers.size(), 1U);
  EXPECT_EQ(apart.registers[0].others.size(), 1U);
  EXPECT_EQ(apart.registers[0].width(), 16);
  EXPECT_FALSE(apart.registers[0].holds()) << "each is read in the next stage alone";
}

TEST(Registers, AResultThatIsReadWhenTheNextComesHasItsOwnRegister) {
  const Placement held = of_two_products(3, 6);
  ASSERT_GE(held.registers.size(), 2U);
  for (const Register& r : held.registers) EXPECT_TRUE(r.others.empty());
}

/// Products of 8 bits of inputs and of other products.
Graph random_products(Seeded& random) {
  Graph g("products");
  std::vector<NodeId> values;
  for (const char* const name : {"a", "b", "c", "d"}) values.push_back(g.input(name, 8, true));
  for (int i = 0; i < 12; ++i) {
    const auto any = [&] {
      return values[static_cast<std::size_t>(random.below(static_cast<int>(values.size())))];
    };
    const NodeId product = g.binary(Op::mul, any(), any(), true);
    const int low = random.below(9);
    values.push_back(g.slice(product, low + 7, low));
  }
  for (std::size_t i = 8; i < values.size(); ++i) g.output(fmt::format("o{}", i), values[i]);
  return canonical(g);
}

/// Each bit that a placement without sharing latches is in one register, and nothing overwrites it there.
TEST(Registers, RandomSharedResultsStayUntilTheyAreRead) {
  constexpr int graphs = 300;
  Seeded random(151);
  const Library library = unit_library();
  int together = 0;
  for (int i = 0; i < graphs; ++i) {
    const Graph graph = random_products(random);
    const int interval = 2 + i % 7;
    std::vector<SharingGroup> groups = kinds_of(graph);
    for (SharingGroup& group : groups)
      group.instances = (static_cast<int>(group.operations.size()) + interval - 1) / interval;
    const SharedSchedule s = schedule_modulo(
        {.graph = graph, .library = library, .interval = interval, .groups = groups, .clock_ps = 1000});
    const Placement placement = place_registers(graph, s.schedule, Ports::latched, s.binding);
    const Placement alone = place_registers(graph, s.schedule, Ports::latched, {interval, {}});
    const RegisterTable table(placement, interval);
    EXPECT_EQ(placement.used_bits, alone.used_bits);
    for (const Register& r : alone.registers) {
      const auto found = table.find(r.value, r.high, r.low, r.boundary + 1);
      ASSERT_TRUE(found);
      const Register& in = placement.registers[*found];
      const std::vector<Passing> values = in.values();
      const auto own =
          std::find_if(values.begin(), values.end(), [&](const Passing& p) { return p.value == r.value; });
      ASSERT_EQ(own->boundary, r.boundary);
      ASSERT_GE(own->last, r.last);
      for (const Passing& p : values) {
        if (p.value == r.value) continue;
        ASSERT_EQ(s.binding.instance_of.at(p.value), s.binding.instance_of.at(r.value));
        ++together;
        for (int stage = r.boundary; stage < r.last; ++stage)
          ASSERT_NE((stage - p.boundary) % interval, 0) << "%" << p.value << " overwrites %" << r.value;
      }
    }
  }
  EXPECT_GT(together, graphs) << together;
}

}  // namespace
}  // namespace hitpipe::rtl::registers_test
