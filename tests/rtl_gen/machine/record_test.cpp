// The form of machines: registers that are written once, in any order, and words of memories as records.
#include "hls/machines/record.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hls/machines/memory.hpp"
#include "hls/world/core_format.hpp"
#include "rtl_gen/machine/machine_of.hpp"
#include "rtl_gen/machine/module.hpp"

namespace hitpipe::hls::record_test {

constexpr Data<"enters"> enters;
constexpr Data<"x", &CoreBits::coord> x;
constexpr SignedData<"y", 6> y;
constexpr Data<"largest", &CoreBits::coord> largest;
constexpr SignedData<"last_y", 6> last_y;
constexpr Data<"last_x", &CoreBits::coord> last_x;
constexpr Control<"most", &CoreBits::coord, 3> most;
constexpr Control<"count", 4> count;
constexpr Data<"kept", &CoreBits::coord> kept;
constexpr SignedData<"earlier", 6> earlier;
struct Pair : List<x, y> {};
constexpr BlockOf<"pairs", 16, Pair> pairs;
constexpr std::uint32_t squares_words[16] = {0,  1,  4,   9,   16,  25,  36,  49,
                                             64, 81, 100, 121, 144, 169, 196, 225};
inline constexpr auto squares_contents = [] { return &squares_words[0]; };
constexpr Rom<"squares", squares_contents, 16, 8> squares;
constexpr Data<"square", 8> square;

/// What a step may do otherwise.
enum class Variant { usual, swapped, twice, twice_where, silent };

/// The largest x so far, and the last pair.
template <Variant V>
struct Largest {
  static constexpr const char* name = "largest";
  static constexpr const char* summary = "a machine for tests";
  using Bits = CoreBits;
  using BuiltIn = FormatList<Fixed<CoreBits{{8, 0, 8, 0, 0}, 3}>>;
  struct In : List<enters, x, y> {};
  struct Out : List<largest, last_x, last_y, square> {};
  struct State : List<most, count, kept, earlier> {};
  struct Memory : List<pairs, squares> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    const auto pair = memory[pairs].word();
    out[largest] = now[most];
    out[last_x] = pair[x];
    out[square] = memory[squares].word();
    if constexpr (V != Variant::silent) out[last_y] = pair[y];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit grows = as("grows", in[enters] & Bit(now[most] < in[x]));
    const auto later = [&] {
      next[count] = plus(now[count], in[enters]);
      memory[pairs].ask(now[count]);
      memory[squares].ask(now[count]);
      next[earlier] = in[y];
    };
    if constexpr (V == Variant::swapped) later();
    memory[pairs].write(in[enters], now[count], in[x], in[y]);
    next.where(grows)[most] = in[x];
    if constexpr (V == Variant::twice) next[most] = in[x];
    if constexpr (V == Variant::twice_where) next.where(in[enters])[count] = now[count];
    if constexpr (V != Variant::swapped) later();
  }
};

using Registers = Values<Native, Fixed<CoreBits{}>, Largest<Variant::usual>::State>;
using NextCount = decltype(std::declval<Next<Registers, NoLog>>()[count]);
template <class X>
concept CanBeRead = requires(X value, ap_uint<4> other) {
  other = value;
}
|| requires(X value) {
  value + value;
};
static_assert(CanBeRead<ap_uint<4>> && !CanBeRead<NextCount>, "the next state can be read");
static_assert(!std::is_assignable_v<NextCount, NextCount>, "the next state can be read");

}  // namespace hitpipe::hls::record_test

namespace hitpipe::rtl::record_test {
namespace {

using hls::record_test::Largest;
using hls::record_test::Variant;
using testing::ElementsAre;
using testing::IsEmpty;

const hls::CoreBits built_in{{8, 0, 8, 0, 0}, 3};

template <Variant V>
MachineGraph graph() {
  return traced_machine<Largest<V>>(built_in);
}

TEST(MachineRecord, KeepsTheRules) {
  EXPECT_THAT(verify(graph<Variant::usual>()), IsEmpty());
}

TEST(MachineRecord, ARegisterThatIsWrittenTwiceIsRefused) {
  EXPECT_THAT(verify(graph<Variant::twice>()), ElementsAre("largest: the step gives next_most 2 times"));
  EXPECT_THAT(verify(graph<Variant::twice_where>()),
              ElementsAre("largest: the step gives next_count 2 times"));
  EXPECT_THROW((void)machine_of<Largest<Variant::twice>>().graph(built_in), std::logic_error);
}

TEST(MachineRecord, AnOutputThatIsNotGivenIsRefused) {
  EXPECT_THAT(verify(graph<Variant::silent>()), ElementsAre("largest: the step gives last_y 0 times"));
}

/// The lines of its Verilog, but not their order: that of memories is the order of statements.
std::multiset<std::string> verilog_lines(const MachineGraph& machine) {
  std::istringstream text(to_verilog(machine, {.module = "m"}));
  std::multiset<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.insert(line);
  return lines;
}

TEST(MachineRecord, TheOrderOfStatementsMeansNothing) {
  EXPECT_EQ(verilog_lines(graph<Variant::usual>()), verilog_lines(graph<Variant::swapped>()));
}

TEST(MachineRecord, AHeldFieldIsARegisterWithItsNameWidthAndSign) {
  const hls::Field held = hls::held<hls::record_test::y>.shape(hls::CoreBits{});
  EXPECT_EQ(std::string(held.name), "y_1");
  EXPECT_EQ(held.width, 6);
  EXPECT_TRUE(held.is_signed);
  EXPECT_FALSE(held.has_reset);
}

TEST(MachineRecord, JoinedListsHaveEachFieldOnce) {
  using hls::record_test::x, hls::record_test::y, hls::record_test::enters;
  using Both = hls::Join<hls::List<x, y>, hls::List<enters, x>>;
  EXPECT_EQ(Both::count, 3U);
  EXPECT_TRUE((std::is_same_v<Both::Items, hls::List<x, y, enters>>));
}

TEST(MachineRecord, ARegisterThatIsNotWrittenKeepsItsValue) {
  const MachineGraph machine = graph<Variant::usual>();
  const auto& outputs = machine.graph.outputs();
  const auto found =
      std::find_if(outputs.begin(), outputs.end(), [](const Output& out) { return out.name == "next_kept"; });
  ASSERT_NE(found, outputs.end());
  EXPECT_EQ(machine.graph[found->node].name, "kept");
}

/// With widths that are compiled, and with others.
TEST(MachineRecord, RunsInSoftware) {
  for (const int coord : {8, 9}) {
    const auto machine = machine_of<Largest<Variant::usual>>().native(hls::CoreBits{{coord, 0, 8, 0, 0}, 3});
    const auto step = [&](std::vector<Word> in, bool reset = false) {
      std::vector<Word> out(4);
      machine->outputs(out.data());
      machine->step(in.data(), reset);
      std::vector<int> numbers;
      for (const Word word : out) numbers.push_back(static_cast<int>(word));
      return numbers;
    };
    step({0, 0, 0}, true);
    EXPECT_THAT(step({1, 2, 0x3f}), ElementsAre(3, 0, 0, 0)) << "2 is less than 3, the value after a reset";
    step({0, 0, 0});  // place 1 is asked for, and here place 1 again
    EXPECT_THAT(step({1, 200, 0x21}), ElementsAre(3, 0, 0, 1));
    EXPECT_THAT(step({0, 255, 0}), ElementsAre(200, 0, 0, 1)) << "the word before the write";
    for (int i = 0; i < 14; ++i) step({1, 7, 1});
    step({0, 0, 0});
    EXPECT_THAT(step({1, 9, 3}), ElementsAre(200, 2, 0x3f, 0)) << "around, at place 0";
    EXPECT_THAT(step({0, 0, 0}), ElementsAre(200, 2, 0x3f, 0));
    EXPECT_THAT(step({0, 0, 0}), ElementsAre(200, 200, 0x21, 1));
  }
}

}  // namespace
}  // namespace hitpipe::rtl::record_test
