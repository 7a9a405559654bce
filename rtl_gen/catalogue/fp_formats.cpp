#include "rtl_gen/catalogue/fp_formats.hpp"

#include <charconv>

#include <fmt/format.h>

namespace hitpipe::rtl::fp_formats {

namespace {

constexpr FormatNumbers binary32 = Format(hls::FpBits{8, 23}).numbers();

}  // namespace

bool valid(const FormatNumbers& numbers) {
  return numbers == binary32;
}

std::string print(const FormatNumbers& numbers) {
  return numbers == binary32 ? "fp32" : fmt::format("e{}m{}", numbers[0], numbers[1]);
}

std::string identifier(const FormatNumbers& numbers) {
  return print(numbers);
}

std::optional<FormatNumbers> parse(std::string_view text) {
  if (text == "fp32") return binary32;
  if (!text.starts_with('e')) return std::nullopt;
  FormatNumbers numbers{};
  const char* const end = text.data() + text.size();
  const auto [mark, bad_exponent] = std::from_chars(text.data() + 1, end, numbers[0]);
  if (bad_exponent != std::errc{} || mark == end || *mark != 'm') return std::nullopt;
  const auto [rest, bad_fraction] = std::from_chars(mark + 1, end, numbers[1]);
  if (bad_fraction != std::errc{} || rest != end) return std::nullopt;
  return numbers;
}

std::string type(const FormatNumbers& numbers) {
  return fmt::format("FpFormat<{}, {}>", numbers[0], numbers[1]);
}

}  // namespace hitpipe::rtl::fp_formats
