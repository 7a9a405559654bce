// The number format of a design, chosen at run time. Formats come in families, each with its own numbers and
// its own spelling: n/t of integers (int_formats.hpp), eEmM of floats (fp_formats.hpp). A family is one
// struct in hls/box with the numbers and one specialisation of FamilyOf; nothing else knows what the numbers
// mean.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace hitpipe::rtl {

/// What a format consists of, {20, 24} of 20/24; the rest is 0.
using FormatNumbers = std::array<int, 4>;

struct FormatFamily {
  std::string_view syntax;   ///< "n/t"
  std::string_view allowed;  ///< "n/t with n in 6..32 and t in 6..2n-1"
  std::string_view example;  ///< "20/24"
  bool single;               ///< it has one format only, which needs no mention beside a design's name
  bool (*valid)(const FormatNumbers& numbers);
  std::string (*print)(const FormatNumbers& numbers);
  /// "20_24": the same as a part of a Verilog or C++ identifier. No two formats of a family have the same.
  std::string (*identifier)(const FormatNumbers& numbers);
  /// Nothing when the text is not spelled so; what it says may still be invalid.
  std::optional<FormatNumbers> (*parse)(std::string_view text);
  /// "IntFormat<20, 24>": the format as a type of hitpipe::hls.
  std::string (*type)(const FormatNumbers& numbers);
};

/// FamilyOf<Bits>::family is the family of a struct of hls/box that holds a format's numbers.
template <class Bits>
struct FamilyOf;

template <class Bits>
concept format_bits = requires {
  FamilyOf<Bits>::family;
};

class Format {
 public:
  /// Implicit: such a struct is a format.
  template <format_bits Bits>
  constexpr Format(const Bits& bits) : family_(&FamilyOf<Bits>::family) {
    const auto own = std::bit_cast<std::array<int, sizeof(Bits) / sizeof(int)>>(bits);
    for (std::size_t i = 0; i < own.size(); ++i) numbers_[i] = own[i];
  }
  constexpr Format(const FormatFamily& family, const FormatNumbers& numbers)
      : family_(&family), numbers_(numbers) {}

  [[nodiscard]] constexpr const FormatFamily& family() const { return *family_; }
  [[nodiscard]] constexpr const FormatNumbers& numbers() const { return numbers_; }
  [[nodiscard]] bool valid() const { return family_->valid(numbers_); }
  [[nodiscard]] std::string type() const { return family_->type(numbers_); }
  [[nodiscard]] std::string identifier() const { return family_->identifier(numbers_); }

  template <format_bits Bits>
  [[nodiscard]] constexpr bool is() const {
    return family_ == &FamilyOf<Bits>::family;
  }
  /// The numbers as the struct of their family; only where is<Bits>().
  template <format_bits Bits>
  [[nodiscard]] constexpr Bits as() const {
    std::array<int, sizeof(Bits) / sizeof(int)> own{};
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = numbers_[i];
    return std::bit_cast<Bits>(own);
  }

  friend constexpr bool operator==(const Format&, const Format&) = default;

 private:
  const FormatFamily* family_;
  FormatNumbers numbers_{};
};

/// "20/24", "fp32".
[[nodiscard]] inline std::string to_string(const Format& format) {
  return format.family().print(format.numbers());
}

}  // namespace hitpipe::rtl
