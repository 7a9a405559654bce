// Formats n+g/p of designs with a major axis (hls/box/major_format.hpp).
#pragma once

#include "hls/box/major_format.hpp"
#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::rtl {

namespace major_formats {
[[nodiscard]] bool valid(const FormatNumbers& numbers);
[[nodiscard]] std::string print(const FormatNumbers& numbers);
[[nodiscard]] std::string identifier(const FormatNumbers& numbers);
[[nodiscard]] std::optional<FormatNumbers> parse(std::string_view text);
[[nodiscard]] std::string type(const FormatNumbers& numbers);
}  // namespace major_formats

template <>
struct FamilyOf<hls::MajorBits> {
  static constexpr FormatFamily family{
      .syntax = "n+g/p",
      .allowed = "n+g/p or n+g/pfF with n in 6..32, g in 0..3, p in 4..32, F in -2..3 and n+g+p at most 63",
      .example = "20+1/13",
      .single = false,
      .valid = major_formats::valid,
      .print = major_formats::print,
      .identifier = major_formats::identifier,
      .parse = major_formats::parse,
      .type = major_formats::type};
};
static_assert(hls::MajorBits::min_coord == 6 && hls::MajorBits::max_coord == 32 &&
              hls::MajorBits::max_finer == 3 && hls::MajorBits::min_mantissa == 4 &&
              hls::MajorBits::max_mantissa == 32 && hls::MajorBits::min_fraction == -2 &&
              hls::MajorBits::max_fraction == 3 && hls::MajorBits::max_product == 63);

}  // namespace hitpipe::rtl
