// Judges a triangle unit against exact integers over the categories of sw_ref/world/int_cases.hpp. The cases
// of a category follow from the seed and its place in the list. Threads change nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/piece.hpp"
#include "sim/check/triangle_test.hpp"
#include "sim/unit/verilated_design.hpp"
#include "sw_ref/world/int_cases.hpp"

namespace hitpipe::sim {

struct TriangleCheckOptions {
  std::vector<ref::IntCategory> categories;  ///< which to draw from
  std::uint64_t tests = 1'000'000;           ///< of all categories, which have equal shares
  std::uint64_t seed = 1;
  host::Piece piece{};  ///< of the batches of tests (shares.hpp); only these are judged
  int threads = 1;
  const VerilatedDesign* rtl = nullptr;  ///< answers each test too, when given
  /// Told the finished share of the tests, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
};

struct TriangleCategoryResult {
  std::string category;
  std::uint64_t tests = 0;
  std::uint64_t hits = 0;   ///< by exact integers
  std::uint64_t wrong = 0;  ///< another HIT, T, determinant or weight
  std::uint64_t rtl_mismatches = 0;
  std::optional<ref::IntCase> first_wrong;

  TriangleCategoryResult& operator+=(const TriangleCategoryResult& later);
};

using MakeTriangleTest = std::function<std::unique_ptr<TriangleTest>()>;

/// One result for each category, in order.
[[nodiscard]] std::vector<TriangleCategoryResult> check_triangles(const MakeTriangleTest& make,
                                                                  const TriangleCheckOptions& options);

}  // namespace hitpipe::sim
