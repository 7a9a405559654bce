// Gates of one bit, and the lookup tables that cover them: an estimate of what a mapper makes of a stage's logic.
// Gates of the same inputs are one. A cover is chosen by area flow over the best few cuts of each gate, as ABC
// does, though without its rewriting.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace hitpipe::area {

class GateNetwork {
 public:
  /// A signal: twice its number, and one more if it is inverted.
  using Signal = std::uint32_t;
  static constexpr Signal zero = 0, one = 1;
  static constexpr int most_table_inputs = 16;

  /// A bit that comes from elsewhere, and no table makes it: from a register, a carry chain or a block.
  Signal leaf();
  Signal both(Signal a, Signal b);
  Signal either(Signal a, Signal b) { return both(a ^ 1U, b ^ 1U) ^ 1U; }
  Signal differ(Signal a, Signal b);
  Signal select(Signal s, Signal if_one, Signal if_zero);

  /// The signal leaves the tables: something else than a gate reads it.
  void reads(Signal s) { read_.push_back(s >> 1U); }
  /// The same for what reads it as it is: the inverse of a leaf is a table.
  void reads_as_is(Signal s);
  /// Gates made from here on belong to this owner, numbered from 0.
  void begin_owner(int owner) { owner_ = owner; }

  /// How many tables each owner needs for all that is read. A table has so many inputs.
  [[nodiscard]] std::vector<int> tables(int inputs, int owners) const;

 private:
  enum class Kind : std::uint8_t { leaf, both, differ };
  struct Gate {
    Kind kind;
    std::array<Signal, 2> args;
    int owner;
  };
  Signal record(Kind kind, Signal a, Signal b);

  std::vector<Gate> gates_{{Kind::leaf, {}, -1}};  // the first is the constant
  std::map<std::tuple<Kind, Signal, Signal>, Signal> known_;
  std::vector<std::uint32_t> read_;
  int owner_ = 0;
};

}  // namespace hitpipe::area
