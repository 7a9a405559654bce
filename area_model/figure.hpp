// Turns exact integers into decimal figures, with as many digits as Table 7.2.
#pragma once

#include <cstdint>
#include <string>

#include "area_model/price.hpp"

namespace hitpipe::area {

/// dividend / divisor with `digits` digits after the point; halves are rounded up. Both are not negative.
[[nodiscard]] std::string decimal(std::int64_t dividend, std::int64_t divisor, int digits);

[[nodiscard]] std::string area_mm2(std::int64_t area_um2);
[[nodiscard]] std::string delay_ns(std::int64_t delay_ps);
[[nodiscard]] std::string clock_mhz(const Price& price);
/// For each box of a test.
[[nodiscard]] std::string adp_mm2_ns(const Price& price);
/// In millions.
[[nodiscard]] std::string megaboxes_per_second(const Price& price);
/// The part in percent of the whole, without decimals.
[[nodiscard]] std::string percent(std::int64_t part, std::int64_t whole);

}  // namespace hitpipe::area
