// Formats n/t of integer designs (hls/box/int_format.hpp).
#pragma once

#include "hls/box/int_format.hpp"
#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::rtl {

namespace int_formats {
[[nodiscard]] bool valid(const FormatNumbers& numbers);
[[nodiscard]] std::string print(const FormatNumbers& numbers);
[[nodiscard]] std::string identifier(const FormatNumbers& numbers);
[[nodiscard]] std::optional<FormatNumbers> parse(std::string_view text);
[[nodiscard]] std::string type(const FormatNumbers& numbers);
}  // namespace int_formats

template <>
struct FamilyOf<hls::IntBits> {
  static constexpr FormatFamily family{.syntax = "n/t",
                                       .allowed = "n/t with n in 6..32 and t in 6..2n-1",
                                       .example = "20/24",
                                       .single = false,
                                       .valid = int_formats::valid,
                                       .print = int_formats::print,
                                       .identifier = int_formats::identifier,
                                       .parse = int_formats::parse,
                                       .type = int_formats::type};
};
static_assert(hls::IntBits::min_coord == 6 && hls::IntBits::max_coord == 32 &&
              hls::IntBits::min_interval == 6);

/// For those who have a format n/t and no design. Throws std::runtime_error naming the text and what is
/// allowed.
[[nodiscard]] hls::IntBits parse_bits(std::string_view text);

}  // namespace hitpipe::rtl
