#include "rtl_gen/catalogue/any_fp_formats.hpp"

#include <fmt/format.h>

namespace hitpipe::rtl::any_fp_formats {

bool valid(const FormatNumbers& numbers) {
  return hls::AnyFpBits(numbers[0], numbers[1]).valid();
}

std::string print(const FormatNumbers& numbers) {
  return fmt::format("e{}m{}", numbers[0], numbers[1]);
}

}  // namespace hitpipe::rtl::any_fp_formats
