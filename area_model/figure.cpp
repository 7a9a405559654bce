#include "area_model/figure.hpp"

#include <fmt/format.h>

namespace hitpipe::area {

std::string decimal(std::int64_t dividend, std::int64_t divisor, int digits) {
  std::int64_t scale = 1;
  for (int i = 0; i < digits; ++i) scale *= 10;
  const std::int64_t scaled =
      dividend / divisor * scale + (dividend % divisor * scale + divisor / 2) / divisor;
  if (digits == 0) return fmt::format("{}", scaled);
  return fmt::format("{}.{:0{}}", scaled / scale, scaled % scale, digits);
}

std::string area_mm2(std::int64_t area_um2) {
  return decimal(area_um2, 1'000'000, 4);
}

std::string delay_ns(std::int64_t delay_ps) {
  return decimal(delay_ps, 1000, 3);
}

std::string clock_mhz(const Price& price) {
  return decimal(1'000'000, price.stage_delay_ps, 0);
}

std::string adp_mm2_ns(const Price& price) {
  return decimal(price.area_delay_per_box(), 1'000'000'000, 3);
}

std::string megaboxes_per_second(const Price& price) {
  return decimal(price.boxes_per_second(), 1'000'000, 1);
}

std::string percent(std::int64_t part, std::int64_t whole) {
  return decimal(100 * part, whole, 0);
}

}  // namespace hitpipe::area
