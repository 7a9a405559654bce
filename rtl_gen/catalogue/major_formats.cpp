#include "rtl_gen/catalogue/major_formats.hpp"

#include <charconv>

#include <fmt/format.h>

namespace hitpipe::rtl::major_formats {

namespace {

/// Reads a number from the front of the text; false when there is none.
bool take(std::string_view& text, int& number) {
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return true;
}

bool take(std::string_view& text, char letter) {
  if (text.empty() || text.front() != letter) return false;
  text.remove_prefix(1);
  return true;
}

hls::MajorBits bits_of(const FormatNumbers& numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace

bool valid(const FormatNumbers& numbers) {
  return bits_of(numbers).valid();
}

std::string print(const FormatNumbers& numbers) {
  const auto [coord, finer, mantissa, fraction] = numbers;
  const std::string text = fmt::format("{}+{}/{}", coord, finer, mantissa);
  return fraction == 0 ? text : fmt::format("{}f{}", text, fraction);
}

// "20p1_13", "20p1_13f2", "20p1_13fm2": p for plus, m for minus.
std::string identifier(const FormatNumbers& numbers) {
  const auto [coord, finer, mantissa, fraction] = numbers;
  const std::string text = fmt::format("{}p{}_{}", coord, finer, mantissa);
  if (fraction == 0) return text;
  return fraction < 0 ? fmt::format("{}fm{}", text, -fraction) : fmt::format("{}f{}", text, fraction);
}

std::optional<FormatNumbers> parse(std::string_view text) {
  FormatNumbers numbers{};
  auto& [coord, finer, mantissa, fraction] = numbers;
  if (!take(text, coord) || !take(text, '+') || !take(text, finer) || !take(text, '/') ||
      !take(text, mantissa))
    return std::nullopt;
  if (take(text, 'f') && !take(text, fraction)) return std::nullopt;
  if (!text.empty()) return std::nullopt;
  return numbers;
}

std::string type(const FormatNumbers& numbers) {
  const auto [coord, finer, mantissa, fraction] = numbers;
  return fmt::format("MajorFormat<{}, {}, {}, {}>", coord, finer, mantissa, fraction);
}

}  // namespace hitpipe::rtl::major_formats
