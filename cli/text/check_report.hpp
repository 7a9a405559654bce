// What a check found, as it is printed, and as a piece keeps it in its file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/check/check.hpp"

namespace hitpipe::cli {

struct CheckFindings {
  std::string design;
  Format format;
  std::uint64_t seed = 1;
  bool rtl = false;                               ///< the Verilog answered too
  std::vector<sim::CategoryResult> categories{};  ///< in order
  std::vector<sim::CategoryResult> comparison{};  ///< the same of the design's comparison, if it has one

  /// Of the same check.
  CheckFindings& operator+=(const CheckFindings& later);
};

/// Of several units, each with as many tests.
struct UnitsFindings {
  std::vector<CheckFindings> units;

  /// Of the same check.
  UnitsFindings& operator+=(const UnitsFindings& later);
};

/// With all sums, so that intervals of joined findings are those of all tests.
[[nodiscard]] Row to_row(const CheckFindings& findings);

/// Throws nlohmann's exceptions for another form, and what rtl::find_design() and parse_format() throw.
[[nodiscard]] CheckFindings parse_findings(const Row& row);

[[nodiscard]] Row to_row(const UnitsFindings& findings);
/// Throws what parse_findings() throws.
[[nodiscard]] UnitsFindings parse_units_findings(const Row& row);

/// The exit code for these counts.
[[nodiscard]] int check_verdict(const rtl::Design& design, std::uint64_t false_misses,
                                std::uint64_t rtl_mismatches);

/// Prints them, wrong answers on standard error, and returns the exit code.
int report_findings(const CheckFindings& findings, OutputFormat format);

/// The same for several units, in one table without comparisons.
int report_findings(const UnitsFindings& findings, OutputFormat format);

}  // namespace hitpipe::cli
