// Formats eEmM of float designs (hls/box/fp_format.hpp): e8m23 is binary32, which is written fp32.
#pragma once

#include "hls/box/fp_format.hpp"
#include "rtl_gen/catalogue/format.hpp"

namespace hitpipe::rtl {

namespace fp_formats {
/// The set-up of rays and boxes makes binary32 operands only.
[[nodiscard]] bool valid(const FormatNumbers& numbers);
[[nodiscard]] std::string print(const FormatNumbers& numbers);
[[nodiscard]] std::string identifier(const FormatNumbers& numbers);
[[nodiscard]] std::optional<FormatNumbers> parse(std::string_view text);
[[nodiscard]] std::string type(const FormatNumbers& numbers);
}  // namespace fp_formats

template <>
struct FamilyOf<hls::FpBits> {
  static constexpr FormatFamily family{.syntax = "eEmM",
                                       .allowed = "fp32, which is e8m23",
                                       .example = "fp32",
                                       .single = true,
                                       .valid = fp_formats::valid,
                                       .print = fp_formats::print,
                                       .identifier = fp_formats::identifier,
                                       .parse = fp_formats::parse,
                                       .type = fp_formats::type};
};

}  // namespace hitpipe::rtl
