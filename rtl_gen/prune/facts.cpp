#include "rtl_gen/prune/facts.hpp"

#include <algorithm>
#include <bit>

namespace hitpipe::rtl {

namespace {

Interval all_signed(int width) {
  const auto most = static_cast<std::int64_t>(all_bits(width) >> 1);
  return {-most - 1, most};
}

}  // namespace

Facts::Facts(int width, std::uint64_t zeros, std::uint64_t ones, Interval number)
    : width_(width), zeros_(zeros), ones_(ones), number_(number) {
  sharpen();
}

/// Known bits bound the number; both ends of its interval must have the known low bits; and all numbers of
/// the interval agree in the bits above the highest one in which its ends differ.
void Facts::sharpen() {
  const std::uint64_t sign = std::uint64_t{1} << (width_ - 1);
  const std::uint64_t least = ones_ | (sign & ~zeros_);
  const std::uint64_t most = (~zeros_ & all_bits(width_) & ~sign) | (ones_ & sign);
  number_.low = std::max(number_.low, number_of(least, width_));
  number_.high = std::min(number_.high, number_of(most, width_));
  const std::uint64_t below = all_bits(known_low());
  const std::uint64_t low =
      static_cast<std::uint64_t>(number_.low) + ((ones_ - static_cast<std::uint64_t>(number_.low)) & below);
  const std::uint64_t high =
      static_cast<std::uint64_t>(number_.high) - ((static_cast<std::uint64_t>(number_.high) - ones_) & below);
  number_ = {static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)};
  const int differing = 64 - std::countl_zero(low ^ high);
  const std::uint64_t agreed = differing == 64 ? 0 : ~std::uint64_t{0} << differing;
  zeros_ |= ~low & agreed & all_bits(width_);
  ones_ |= low & agreed & all_bits(width_);
}

Facts Facts::nothing(int width) {
  return {width, 0, 0, all_signed(width)};
}

Facts Facts::constant(int width, std::uint64_t pattern) {
  const std::int64_t number = number_of(pattern, width);
  return {width, 0, 0, {number, number}};
}

Facts Facts::number(int width, Wide low, Wide high) {
  const Interval all = all_signed(width);
  if (low < all.low || high > all.high) return nothing(width);
  return {width, 0, 0, {static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)}};
}

Facts Facts::patterns(int width, Patterns p) {
  // Patterns with the top bit clear and set are not one interval of numbers.
  if ((p.low ^ p.high) >> (width - 1) != 0) return nothing(width);
  return number(width, number_of(p.low, width), number_of(p.high, width));
}

Facts Facts::bits(int width, std::uint64_t zeros, std::uint64_t ones) {
  return {width, zeros & all_bits(width), ones & all_bits(width), all_signed(width)};
}

Facts Facts::either(const Facts& a, const Facts& b) {
  return {a.width_,
          a.zeros_ & b.zeros_,
          a.ones_ & b.ones_,
          {std::min(a.number_.low, b.number_.low), std::max(a.number_.high, b.number_.high)}};
}

Facts Facts::both(const Facts& a, const Facts& b) {
  return {a.width_,
          a.zeros_ | b.zeros_,
          a.ones_ | b.ones_,
          {std::max(a.number_.low, b.number_.low), std::min(a.number_.high, b.number_.high)}};
}

Patterns Facts::patterns() const {
  if (number_.low >= 0 || number_.high < 0) {
    return {static_cast<std::uint64_t>(number_.low) & all_bits(width_),
            static_cast<std::uint64_t>(number_.high) & all_bits(width_)};
  }
  return {ones_, ~zeros_ & all_bits(width_)};
}

int Facts::signed_width() const {
  const auto bits_of = [](std::int64_t n) {
    return 65 - std::countl_zero(static_cast<std::uint64_t>(n < 0 ? ~n : n));
  };
  return std::min(width_, std::max(bits_of(number_.low), bits_of(number_.high)));
}

int Facts::unknown_width() const {
  const std::uint64_t unknown = ~(zeros_ | ones_) & all_bits(width_);
  return 64 - std::countl_zero(unknown);
}

int Facts::known_low() const {
  return std::countr_one(zeros_ | ones_);
}

int Facts::low_zeros() const {
  return std::countr_one(zeros_);
}

}  // namespace hitpipe::rtl
