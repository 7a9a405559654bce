#include "rtl_gen/catalogue/int_formats.hpp"

#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace int_formats {

bool valid(const FormatNumbers& numbers) {
  return hls::IntBits{numbers[0], numbers[1]}.valid();
}

std::string print(const FormatNumbers& numbers) {
  return fmt::format("{}/{}", numbers[0], numbers[1]);
}

std::string identifier(const FormatNumbers& numbers) {
  return fmt::format("{}_{}", numbers[0], numbers[1]);
}

std::optional<FormatNumbers> parse(std::string_view text) {
  FormatNumbers numbers{};
  const char* const end = text.data() + text.size();
  const auto [slash, bad_coord] = std::from_chars(text.data(), end, numbers[0]);
  if (bad_coord != std::errc{} || slash == end || *slash != '/') return std::nullopt;
  const auto [rest, bad_interval] = std::from_chars(slash + 1, end, numbers[1]);
  if (bad_interval != std::errc{} || rest != end) return std::nullopt;
  return numbers;
}

std::string type(const FormatNumbers& numbers) {
  return fmt::format("IntFormat<{}, {}>", numbers[0], numbers[1]);
}

}  // namespace int_formats

hls::IntBits parse_bits(std::string_view text) {
  const auto& family = FamilyOf<hls::IntBits>::family;
  const auto numbers = family.parse(text);
  if (!numbers || !family.valid(*numbers))
    throw std::runtime_error(
        fmt::format("bits {}: allowed is {}, for example {}", text, family.allowed, family.example));
  return Format(family, *numbers).as<hls::IntBits>();
}

}  // namespace hitpipe::rtl
