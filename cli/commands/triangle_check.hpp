// `check` of a triangle unit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/design_options.hpp"
#include "cli/text/check_report.hpp"
#include "cli/text/table.hpp"
#include "host/piece.hpp"
#include "sim/check/triangle_check.hpp"

namespace hitpipe::cli {

struct TriangleCheck {
  DesignChoice choice;
  std::vector<std::string> categories;
  std::uint64_t tests;
  std::uint64_t seed;
  int threads;
  bool rtl;
  int interval;
  host::Piece piece;
};

struct TriangleFindings : CheckedUnit {
  std::vector<sim::TriangleCategoryResult> categories{};  ///< in order
  std::string first_wrong{};                              ///< as text; empty: all are right
  double seconds = 0;                                     ///< measured

  /// Of the same check.
  TriangleFindings& operator+=(const TriangleFindings& later);
};

[[nodiscard]] TriangleFindings check_triangle_unit(const TriangleCheck& command);

/// Those of the format with these names. Throws what chosen_of() throws.
[[nodiscard]] std::vector<ref::IntCategory> triangle_categories(const DesignChoice& choice,
                                                                const std::vector<std::string>& names);

void to_json(Row& row, const TriangleFindings& findings);
void from_json(const Row& row, TriangleFindings& findings);

/// Prints the table, wrong answers on standard error, and returns the exit code.
int report_findings(const TriangleFindings& findings, OutputFormat format);

}  // namespace hitpipe::cli
