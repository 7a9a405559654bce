// The ray-box tests of chapter 3 as a list: those of Tables 3.1 and 3.2 in their order, then Woo's. T: float
// or double. They answer for infinite rays of the [-1, 1] cube whose direction has about unit length, and as
// rounding lets them: sw_ref/exact has the referee.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "sw_ref/box_tests/workload.hpp"

namespace hitpipe::ref {

struct BoxAnswer {
  bool hit = false;
  double entry = 0;  ///< of a hit, where the variant has one: t at which the ray enters, 0 from inside
};

/// Pairs made ready for one variant: rays set up, everything converted to its precision.
class PreparedBoxTests {
 public:
  virtual ~PreparedBoxTests() = default;
  struct Sum {
    std::uint64_t hits = 0;
    double entries = 0;
  };
  /// Tests every pair once.
  [[nodiscard]] virtual Sum run() const = 0;
};

struct BoxTestVariant {
  std::string_view name;  ///< as the thesis's tables have it
  bool has_distance;
  BoxAnswer (*ask)(const Ray& ray, const Aabb& box);
  std::unique_ptr<PreparedBoxTests> (*prepare)(std::span<const BoxPair> pairs);
};

template <class T>
[[nodiscard]] std::span<const BoxTestVariant> box_test_variants();
template <>
[[nodiscard]] std::span<const BoxTestVariant> box_test_variants<float>();
template <>
[[nodiscard]] std::span<const BoxTestVariant> box_test_variants<double>();

}  // namespace hitpipe::ref
