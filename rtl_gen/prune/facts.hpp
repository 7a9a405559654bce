// What is known of the values of a graph while the operands meet the demands: intervals and known bits, by an
// analysis that is sound for every operation. For a component with logic of its own (a float operator) it
// analyses that logic. Beside it: which bits of the values are read.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// The bounds of a value in two's complement.
struct Numbers {
  Number low;
  Number high;
  friend bool operator==(const Numbers&, const Numbers&) = default;
};

/// The bounds of a value that is read without a sign.
struct Patterns {
  Word low;
  Word high;
};

class Facts {
 public:
  /// Nothing is known of the value.
  [[nodiscard]] static Facts nothing(int width);
  [[nodiscard]] static Facts constant(int width, Word pattern);
  /// The number in two's complement lies between the two. Nothing is known when they do not fit into the
  /// width.
  [[nodiscard]] static Facts number(int width, Number low, Number high);
  [[nodiscard]] static Facts patterns(int width, Patterns patterns);
  [[nodiscard]] static Facts bits(int width, Word zeros, Word ones);
  /// Facts of a value to which a or b applies.
  [[nodiscard]] static Facts either(const Facts& a, const Facts& b);
  /// Facts of a value to which a and b apply.
  [[nodiscard]] static Facts both(const Facts& a, const Facts& b);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] Word zeros() const { return zeros_; }
  [[nodiscard]] Word ones() const { return ones_; }
  [[nodiscard]] Numbers number() const { return number_; }
  [[nodiscard]] Patterns patterns() const;
  [[nodiscard]] bool is_constant() const { return number_.low == number_.high; }
  /// The bits of a constant.
  [[nodiscard]] Word pattern() const { return static_cast<Word>(number_.low) & ones_below(width_); }
  /// How many low bits hold the number in two's complement: the bits above repeat the highest of them.
  [[nodiscard]] int signed_width() const;
  /// How many low bits are left below the known bits at the top.
  [[nodiscard]] int unknown_width() const;
  /// How many of the lowest bits are known, and how many are 0.
  [[nodiscard]] int known_low() const;
  [[nodiscard]] int low_zeros() const;

 private:
  Facts(int width, Word zeros, Word ones, Numbers number);
  void sharpen();

  int width_;
  Word zeros_;
  Word ones_;
  Numbers number_;
};

/// By node. The demands must have passed check_demands() for the graph's ports.
[[nodiscard]] std::vector<Facts> analyse(const Graph& graph, const Demands& demands);

/// What a demand tells of its port, which has this width and sign.
[[nodiscard]] Facts facts_of(const PortDemand& demand, int width, bool is_signed);

/// By node; 0 for wires and constants. A node that nothing reads still counts as a reader, so run canonical()
/// first.
[[nodiscard]] std::vector<Word> read_bits(const Graph& graph);

}  // namespace hitpipe::rtl
