// Judges a triangle unit against exact integers over the categories of sw_ref/world/int_cases.hpp. The cases
// of a category follow from the seed and its place in the list. Threads change nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/shares.hpp"
#include "sim/software/triangle_software.hpp"
#include "sw_ref/world/int_cases.hpp"

namespace hitpipe::sim {

using TriangleCheckOptions = CheckOptionsOf<ref::IntCategory>;

struct TriangleCategoryResult {
  std::string category;
  std::uint64_t tests = 0;
  std::uint64_t hits = 0;     ///< by exact integers, as the next two
  std::uint64_t ties = 0;     ///< in a format with crossings
  std::uint64_t counted = 0;  ///< ties that are crossings
  std::uint64_t wrong = 0;    ///< another HIT, T, determinant, weight, tie, crossing or side
  std::uint64_t rtl_mismatches = 0;
  std::optional<ref::IntCase> first_wrong;

  TriangleCategoryResult& operator+=(const TriangleCategoryResult& later);
};

using MakeTriangleTest = std::function<std::unique_ptr<TriangleTest>()>;

/// One result for each category, in order.
[[nodiscard]] std::vector<TriangleCategoryResult> check_triangles(const MakeTriangleTest& make,
                                                                  const TriangleCheckOptions& options);

}  // namespace hitpipe::sim
