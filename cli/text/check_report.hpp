// What a check found, as it is printed, and as a piece keeps it in its file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "hls/box/int_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/check/check.hpp"

namespace hitpipe::cli {

/// What was checked, and how.
struct CheckedUnit {
  std::string design{};
  Format format = hls::IntBits{};  ///< of the design
  std::uint64_t seed = 1;
  bool rtl = false;  ///< the Verilog answered too
};

void to_json(Row& row, const CheckedUnit& unit);
/// Throws nlohmann's exceptions for another form, and what rtl::find_design() and parse_format() throw.
void from_json(const Row& row, CheckedUnit& unit);

/// A line: the design, its bits and the seed.
[[nodiscard]] std::string head_of(const CheckedUnit& unit);

struct CheckFindings : CheckedUnit {
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
void to_json(Row& row, const CheckFindings& findings);
void from_json(const Row& row, CheckFindings& findings);
void to_json(Row& row, const UnitsFindings& findings);
void from_json(const Row& row, UnitsFindings& findings);

/// The exit code for these counts.
[[nodiscard]] int check_verdict(const rtl::Design& design, std::uint64_t false_misses,
                                std::uint64_t rtl_mismatches);

/// Prints them, wrong answers on standard error, and returns the exit code.
int report_findings(const CheckFindings& findings, OutputFormat format);

/// The same for several units, in one table without comparisons.
int report_findings(const UnitsFindings& findings, OutputFormat format);

}  // namespace hitpipe::cli
