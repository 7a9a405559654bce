// Prices of units as tables: rows for CSV and JSON, and text of 80 columns with a line for each unit and then a
// column for each, or a line for each stage. A column is said once, for all of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "area_model/price.hpp"
#include "cli/text/table.hpp"

namespace hitpipe::cli {

/// A unit beside the same unit with a test in every cycle.
struct RatedPrice {
  area::Price price;
  area::Price every_cycle;  ///< in a table of rates
};

struct AreaTable {
  std::vector<RatedPrice> units;
  const rtl::Library* library;  ///< of a chip: lookup tables, registers and blocks in place of areas
  bool rates = false;           ///< area against rate: a unit at several intervals
  /// Percentages refer to it, and without it there are none. Percentages and area times delay are for each box;
  /// the rest is of the whole unit.
  std::optional<area::Price> baseline{};
};

[[nodiscard]] std::vector<Row> area_rows(const AreaTable& table, OutputFormat format);
/// `notes`, lines, follow the units of a chip.
[[nodiscard]] std::string area_text(const AreaTable& table, const std::string& notes = "");

[[nodiscard]] std::vector<Row> stage_rows(const AreaTable& table, OutputFormat format);
[[nodiscard]] std::string by_stage_text(const AreaTable& table);

}  // namespace hitpipe::cli
