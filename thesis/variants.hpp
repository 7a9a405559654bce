// The ray-box tests of chapter 3 as a list: Tables 3.1 and 3.2 in their order, then Woo's test. T is
// float or double. They are for infinite rays of the [-1, 1] cube whose direction has about unit length. They
// round; the exact referee is in rays/exact.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "thesis/reference.hpp"
#include "thesis/workload.hpp"

namespace hitpipe::thesis {

struct BoxAnswer {
  bool hit = false;
  double entry = 0;  ///< for a hit, if the variant has one: t at which the ray enters, 0 from inside
};

/// Pairs prepared for one variant: rays are set up, and everything is in its precision.
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
  std::string_view name;  ///< as in the thesis's tables
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

}  // namespace hitpipe::thesis
