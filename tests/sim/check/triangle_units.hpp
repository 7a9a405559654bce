// Triangle units with and without faults, and what the check says of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "hls/num/bits.hpp"
#include "rtl_gen/graph/graph.hpp"
#include "sim/check/triangle_check.hpp"
#include "tests/sim/check/mutations.hpp"

namespace hitpipe::sim::triangle_units {

/// Of all categories.
inline TriangleCategoryResult sum_of(const MakeTriangleTest& make, std::uint64_t tests,
                                     host::Piece piece = {}) {
  TriangleCheckOptions options;
  const auto all = ref::int_categories(make()->world());
  options.categories = {all.begin(), all.end()};
  options.tests = tests;
  options.piece = piece;
  TriangleCategoryResult sum;
  for (const TriangleCategoryResult& each : check_triangles(make, options)) sum += each;
  return sum;
}

inline std::unique_ptr<TriangleTest> unit(const std::string& bits) {
  const rtl::Design& design = rtl::find_design("int_triangle");
  return make_triangle_test(design, design.parse_format(bits));
}

/// A unit as it is.
class Own : public TriangleTest {
 public:
  explicit Own(const std::string& bits) : own_(unit(bits)) {}

  [[nodiscard]] const hls::WorldBits& world() const override { return own_->world(); }
  [[nodiscard]] std::size_t operand_count() const override { return own_->operand_count(); }
  void start(const ref::IntRay& ray) override { own_->start(ray); }
  void operands(const ref::IntTriangle& triangle, std::int64_t* out) const override {
    own_->operands(triangle, out);
  }
  [[nodiscard]] std::optional<ref::IntCrossing> crossing(const std::int64_t* results) const override {
    return own_->crossing(results);
  }
  [[nodiscard]] CrossingFlags crossing_flags(const std::int64_t* results) const override {
    return own_->crossing_flags(results);
  }
  [[nodiscard]] const rtl::Evaluate& evaluate() const override { return own_->evaluate(); }

 private:
  std::unique_ptr<TriangleTest> own_;
};

inline rtl::Graph traced(const std::string& bits = "20+1s20b1") {
  const rtl::Design& design = rtl::find_design("int_triangle");
  return design.trace(design.parse_format(bits));
}

/// A unit whose datapath has a fault.
class FaultyDatapath final : public Own {
 public:
  explicit FaultyDatapath(const std::function<GraphFault>& fault, const std::string& bits = "20+1s20b1")
      : Own(bits),
        ports_(rtl::find_design("int_triangle").ports(format(bits))),
        graph_(mutated(traced(bits), fault)),
        inputs_(ports_.size()),
        results_(rtl::find_design("int_triangle").results(format(bits))) {}

  void operands(const ref::IntTriangle& triangle, std::int64_t* out) const override {
    Own::operands(triangle, out);
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      inputs_[i] = static_cast<std::uint64_t>(out[i]) & ~std::uint64_t{0} >> (64 - ports_[i].width);
  }
  /// Of the operands that were asked for last.
  [[nodiscard]] std::optional<ref::IntCrossing> crossing(const std::int64_t* /*right*/) const override {
    return Own::crossing(results().data());
  }
  [[nodiscard]] CrossingFlags crossing_flags(const std::int64_t* /*right*/) const override {
    return Own::crossing_flags(results().data());
  }

 private:
  [[nodiscard]] std::vector<std::int64_t> results() const {
    const std::vector<std::uint64_t> bits = rtl::evaluate(graph_, inputs_);
    std::vector<std::int64_t> results(bits.size());
    for (std::size_t i = 0; i < bits.size(); ++i)
      results[i] = results_[i].is_signed ? hls::sign_extended(bits[i], results_[i].width)
                                         : static_cast<std::int64_t>(bits[i]);
    return results;
  }
  static Format format(const std::string& bits) {
    return rtl::find_design("int_triangle").parse_format(bits);
  }

  std::vector<rtl::Port> ports_;
  rtl::Graph graph_;
  mutable std::vector<std::uint64_t> inputs_;
  std::vector<hls::Result> results_;
};

struct DatapathFault {
  std::string name;
  std::function<GraphFault> fault;
};

inline void PrintTo(const DatapathFault& fault, std::ostream* out) {
  *out << fault.name;
}

}  // namespace hitpipe::sim::triangle_units
