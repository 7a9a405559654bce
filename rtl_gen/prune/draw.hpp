// Random operands as demanded, what a fitted unit is tested with: any ones, and ones a step from a hit. One
// program draws the same from a seed wherever it runs.
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

 private:
  struct Order {
    std::size_t lesser, greater;
  };
  /// As the orders want them; false when an order or a port's number is then not as demanded.
  [[nodiscard]] bool put_in_order(std::vector<std::int64_t>& operands) const;

  std::vector<PortDemand> wanted_;  ///< of each port
  std::vector<Order> orders_;
  std::vector<Order> boxes_;       ///< lower and upper plane of a box on an axis
  std::vector<std::size_t> free_;  ///< ports of more than one number
};

/// Operands and all their results by the design's C++.
struct Vector {
  std::vector<std::int64_t> operands;
  std::vector<std::int64_t> results;
};
[[nodiscard]] Vector judged(std::vector<std::int64_t> operands, const Evaluate& evaluate);

/// In turn any operands, and ones beside the last that hit: of any ones few do. What is beside goes astray in
/// a walk through all hits, and meets their border at every other step.
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
