// What is known of the values of a graph while the operands meet the demands: intervals and known bits, by an
// analysis that is sound for every operation. For a component with logic of its own (a float operator) it
// analyses that logic. Beside it: which bits of the values are read.
#pragma once

#include <cstdint>
#include <vector>

#include "hls/num/bits.hpp"
#include "rtl_gen/graph/graph.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// Holds the result of 64-bit operands before it is known to fit into 64 bits.
__extension__ using Wide = __int128;

/// The bounds of a value that is read without a sign.
struct Patterns {
  std::uint64_t low;
  std::uint64_t high;
};

class Facts {
 public:
  /// Nothing is known of the value.
  [[nodiscard]] static Facts nothing(int width);
  [[nodiscard]] static Facts constant(int width, std::uint64_t pattern);
  /// The number in two's complement lies between the two. Nothing is known when they do not fit into the
  /// width.
  [[nodiscard]] static Facts number(int width, Wide low, Wide high);
  [[nodiscard]] static Facts patterns(int width, Patterns patterns);
  [[nodiscard]] static Facts bits(int width, std::uint64_t zeros, std::uint64_t ones);
  /// Facts of a value to which a or b applies.
  [[nodiscard]] static Facts either(const Facts& a, const Facts& b);
  /// Facts of a value to which a and b apply.
  [[nodiscard]] static Facts both(const Facts& a, const Facts& b);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] std::uint64_t zeros() const { return zeros_; }
  [[nodiscard]] std::uint64_t ones() const { return ones_; }
  [[nodiscard]] Interval number() const { return number_; }
  [[nodiscard]] Patterns patterns() const;
  [[nodiscard]] bool is_constant() const { return number_.low == number_.high; }
  /// The bits of a constant.
  [[nodiscard]] std::uint64_t pattern() const {
    return static_cast<std::uint64_t>(number_.low) & hls::low_mask(width_);
  }
  /// How many low bits hold the number in two's complement: the bits above repeat the highest of them.
  [[nodiscard]] int signed_width() const;
  /// How many low bits are left below the known bits at the top.
  [[nodiscard]] int unknown_width() const;
  /// How many of the lowest bits are known, and how many are 0.
  [[nodiscard]] int known_low() const;
  [[nodiscard]] int low_zeros() const;

 private:
  Facts(int width, std::uint64_t zeros, std::uint64_t ones, Interval number);
  void sharpen();

  int width_;
  std::uint64_t zeros_;
  std::uint64_t ones_;
  Interval number_;
};

/// By node. The demands must have passed check_demands() for the graph's ports.
[[nodiscard]] std::vector<Facts> analyse(const Graph& graph, const Demands& demands);

/// What a demand tells of its port, which has this width and sign.
[[nodiscard]] Facts facts_of(const PortDemand& demand, int width, bool is_signed);

/// By node; 0 for wires and constants. A node that nothing reads still counts as a reader, so run canonical()
/// first.
[[nodiscard]] std::vector<std::uint64_t> read_bits(const Graph& graph);

}  // namespace hitpipe::rtl
