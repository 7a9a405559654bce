// Formats eEmM of float designs for which any of them will do (hls/box/any_fp_format.hpp).
#pragma once

#include "hls/box/any_fp_format.hpp"
#include "rtl_gen/catalogue/fp_formats.hpp"

namespace hitpipe::rtl {

namespace any_fp_formats {
[[nodiscard]] bool valid(const FormatNumbers& numbers);
[[nodiscard]] std::string print(const FormatNumbers& numbers);
}  // namespace any_fp_formats

template <>
struct FamilyOf<hls::AnyFpBits> {
  static constexpr FormatFamily family{.syntax = "eEmM",
                                       .allowed = "eEmM with E in 2..8 and M in 1..23",
                                       .example = "e8m15",
                                       .single = false,
                                       .valid = any_fp_formats::valid,
                                       .print = any_fp_formats::print,
                                       .identifier = any_fp_formats::print,
                                       .parse = fp_formats::parse,
                                       .type = fp_formats::type};
};

}  // namespace hitpipe::rtl
