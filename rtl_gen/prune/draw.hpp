// Random operands that meet the demands, which test a fitted unit: operands from anywhere, and neighbours of
// a hit. One program draws the same operands from a seed on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "rtl_gen/catalogue/evaluate.hpp"
#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// Operands in port order that meet the demands: ends of intervals, numbers near them, near 0, and any.
/// Drawing throws std::runtime_error, one line, when no draw of 100,000 meets them.
class Draw {
 public:
  Draw(const std::vector<Port>& ports, const Demands& demands);

  [[nodiscard]] std::vector<std::int64_t> operator()(std::mt19937_64& random) const;
  /// One or two ports of `operands`, as demanded themselves, are drawn again or moved a little.
  [[nodiscard]] std::vector<std::int64_t> beside(const std::vector<std::int64_t>& operands,
                                                 std::mt19937_64& random) const;
  /// Operands with most ports at a corner. Corners of a port are the ends of its numbers and of the numbers
  /// that the set-up gives, numbers near 0, powers of two, and another port's number plus or minus such a
  /// number. A float also has infinity, NaN and the ends of the subnormals.
  [[nodiscard]] std::vector<std::int64_t> corners(std::mt19937_64& random) const;
  /// `operands` with all points times a power of two, and all directions times another. A hit often stays one
  /// where floats overflow or are subnormal. Only floats with an exponent of 8 bits are read right; of others
  /// the result is some operands.
  [[nodiscard]] std::vector<std::int64_t> scaled(const std::vector<std::int64_t>& operands,
                                                 std::mt19937_64& random) const;
  /// A few ports of `operands`, as demanded themselves, are put at a corner.
  [[nodiscard]] std::vector<std::int64_t> corners_beside(const std::vector<std::int64_t>& operands,
                                                         std::mt19937_64& random) const;

  /// Ports that may have more than one number.
  [[nodiscard]] const std::vector<std::size_t>& free_ports() const { return free_; }
  /// Another number of that port, from the interval that holds its number in `operands`.
  [[nodiscard]] std::int64_t another(const std::vector<std::int64_t>& operands, std::size_t port,
                                     std::mt19937_64& random) const;
  /// `from` with one of the port's bits changed.
  [[nodiscard]] std::int64_t one_bit_changed(std::int64_t from, std::size_t port,
                                             std::mt19937_64& random) const;
  /// The multiple of the port's unit halfway between `low` and `high`, rounded towards `low`; `low` if no
  /// multiple lies between. Floats are ordered by value.
  [[nodiscard]] std::int64_t halfway(std::size_t port, std::int64_t low, std::int64_t high) const;
  [[nodiscard]] bool meets_all(const std::vector<std::int64_t>& operands) const;

 private:
  struct Order {
    std::size_t lesser, greater;
  };
  /// A corner that meets the demand, or the number that the port has if chance finds none.
  [[nodiscard]] std::int64_t corner(const std::vector<std::int64_t>& operands, std::size_t port,
                                    std::mt19937_64& random) const;
  /// The first operands that `make` gives and that can be put in order. Throws if there are none.
  template <class Make>
  [[nodiscard]] std::vector<std::int64_t> drawn(const Make& make) const;
  /// `operands` with a few free ports changed: change(operands, port) gives the new number.
  template <class Change>
  [[nodiscard]] std::vector<std::int64_t> changed(const std::vector<std::int64_t>& operands,
                                                  std::uint64_t most_changes, std::mt19937_64& random,
                                                  const Change& change) const;
  /// Exchanges numbers until all orders hold; false if an order or a port's demand is then broken.
  [[nodiscard]] bool put_in_order(std::vector<std::int64_t>& operands) const;

  std::vector<Port> ports_;
  std::vector<PortDemand> wanted_;               ///< of each port
  std::vector<std::vector<std::int64_t>> ends_;  ///< of each port, as demanded
  std::vector<Order> orders_;
  std::vector<Order> boxes_;       ///< lower and upper plane of a box on an axis
  std::vector<std::size_t> free_;  ///< ports of more than one number
};

/// Operands and all their results by the design's C++.
struct Vector {
  std::vector<std::int64_t> operands;
  std::vector<std::int64_t> results;
};
[[nodiscard]] Vector with_results(std::vector<std::int64_t> operands, const Evaluate& evaluate);

/// Alternates random operands with neighbours of the last hit, because few random operands hit. The
/// neighbours walk along the border of the hits.
class DrawVectors {
 public:
  /// Looks for a first hit, for a while.
  DrawVectors(const std::vector<Port>& ports, const Demands& demands, const Evaluate& evaluate,
              std::uint64_t seed);

  [[nodiscard]] Vector operator()();

 private:
  /// The drawn operands with their results; remembers them when they hit.
  [[nodiscard]] Vector noted(std::vector<std::int64_t> operands);

  Draw draw_;
  Evaluate evaluate_;
  std::mt19937_64 random_;
  std::vector<std::int64_t> last_hit_;  ///< none yet: empty
  bool beside_ = false;
};

}  // namespace hitpipe::rtl
