// Prices of designs as text of 80 columns: a line for each design, then a column for each design; or a line
// for each stage.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "area_model/price.hpp"

namespace hitpipe::cli {

/// Percentages refer to `baseline`. Without one there are none. Percentages and area times delay are for
/// each box; the rest is of the whole unit.
[[nodiscard]] std::string area_text(const std::vector<area::Price>& prices,
                                    const std::optional<area::Price>& baseline);

[[nodiscard]] std::string by_stage_text(const std::vector<area::Price>& prices);

/// The same for the library of a chip: lookup tables, registers and blocks in place of areas. The notes,
/// lines, follow the units.
[[nodiscard]] std::string chip_text(const std::vector<area::Price>& prices, const rtl::Library& library,
                                    const std::string& notes);
[[nodiscard]] std::string chip_by_stage_text(const std::vector<area::Price>& prices, const rtl::Chip& chip);

/// A unit beside the same unit with a test in every cycle.
struct RatedPrice {
  area::Price price;
  area::Price every_cycle;
};

/// Area against rate: a line for each unit and interval, then a column for each. Of a chip lookup tables,
/// registers and blocks in place of areas.
[[nodiscard]] std::string rates_text(const std::vector<RatedPrice>& units, const rtl::Library& library);

}  // namespace hitpipe::cli
