// Prices of designs as text that fits 80 columns: a line a design, then a column a design; or a line a stage.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "area_model/price.hpp"

namespace hitpipe::cli {

/// Percentages refer to `yardstick`, and are left out without one.
[[nodiscard]] std::string area_text(const std::vector<area::Price>& prices,
                                    const std::optional<area::Price>& yardstick);

[[nodiscard]] std::string by_stage_text(const std::vector<area::Price>& prices);

}  // namespace hitpipe::cli
