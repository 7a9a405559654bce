// The number format of a design, chosen at run time. Formats come in families, each with its own numbers and
// its own spelling: n/t of integers, eEmM of floats. A family is one struct of ints that describes itself
// (hls/box/format.hpp); nothing here knows what the numbers mean.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hls/box/format.hpp"

namespace hitpipe {

/// What a format consists of, {20, 24} of 20/24; the rest is 0.
using FormatNumbers = std::array<int, 8>;

struct FormatFamily {
  std::span<const hls::FormatField> fields;
  const char* condition;      ///< null: none
  const char* alias;          ///< another name of the usual format; null: none
  const char* type_name;      ///< null: no format is a type
  FormatNumbers usual;        ///< of the struct's default
  FormatNumbers for_example;  ///< of the format that messages show
  bool single;                ///< it has the usual format only, which needs no mention beside a design's name
  bool (*valid)(const FormatNumbers& numbers);

  /// "n/t with n in 6..32 and t in 6..2n-1".
  [[nodiscard]] std::string allowed() const;
  [[nodiscard]] std::string print(const FormatNumbers& numbers) const;
  /// "20_24": the same as a part of a Verilog or C++ identifier. No two formats of a family have the same.
  [[nodiscard]] std::string identifier(const FormatNumbers& numbers) const;
  /// Nothing when the text is not spelled so; what it says may still be invalid. An n in front of a digit,
  /// which CSV files have, does not count.
  [[nodiscard]] std::optional<FormatNumbers> parse(std::string_view text) const;
  /// "IntFormat<20, 24>": the format as a type of hitpipe::hls. Throws std::runtime_error when there is none.
  [[nodiscard]] std::string type(const FormatNumbers& numbers) const;
  /// Each number is within its limits.
  [[nodiscard]] bool within_limits(const FormatNumbers& numbers) const;
};

/// A struct of ints that describes itself.
template <class Bits>
concept format_bits = requires {
  std::span<const hls::FormatField>(Bits::fields);
};

template <format_bits Bits>
constexpr FormatNumbers numbers_of(const Bits& bits) {
  using Own = std::array<int, std::size(Bits::fields)>;
  static_assert(std::size(Bits::fields) <= std::size(FormatNumbers()) && sizeof(Own) == sizeof(Bits));
  FormatNumbers numbers{};
  std::ranges::copy(std::bit_cast<Own>(bits), numbers.begin());
  return numbers;
}

template <format_bits Bits>
constexpr Bits bits_of(const FormatNumbers& numbers) {
  std::array<int, std::size(Bits::fields)> own{};
  std::copy_n(numbers.begin(), own.size(), own.begin());
  return std::bit_cast<Bits>(own);
}

namespace detail {

template <class Bits>
constexpr FormatFamily described() {
  FormatFamily family{.fields = Bits::fields,
                      .condition = nullptr,
                      .alias = nullptr,
                      .type_name = nullptr,
                      .usual = numbers_of(Bits{}),
                      .for_example = numbers_of(Bits{}),
                      .single = false,
                      .valid = nullptr};
  if constexpr (requires { Bits::condition; }) family.condition = Bits::condition;
  if constexpr (requires { Bits::type; }) family.type_name = Bits::type;
  if constexpr (requires { Bits::alias; }) family.alias = Bits::alias;
  if constexpr (requires { requires Bits::single; }) {
    family.single = true;
  } else if constexpr (requires { Bits::example(); }) {
    family.for_example = numbers_of(Bits::example());
  }
  return family;
}

}  // namespace detail

/// The family of a struct of ints.
template <format_bits Bits>
inline constexpr FormatFamily family_of = [] {
  FormatFamily family = detail::described<Bits>();
  family.valid = [](const FormatNumbers& numbers) {
    const FormatFamily& own = family_of<Bits>;
    if (own.single) return numbers == own.usual;
    if constexpr (requires(const Bits& bits) { bits.valid(); })
      return own.within_limits(numbers) && bits_of<Bits>(numbers).valid();
    return own.within_limits(numbers);
  };
  return family;
}();

class Format {
 public:
  /// Implicit: such a struct is a format.
  template <format_bits Bits>
  constexpr Format(const Bits& bits) : family_(&family_of<Bits>), numbers_(numbers_of(bits)) {}
  constexpr Format(const FormatFamily& family, const FormatNumbers& numbers)
      : family_(&family), numbers_(numbers) {}

  [[nodiscard]] constexpr const FormatFamily& family() const { return *family_; }
  [[nodiscard]] constexpr const FormatNumbers& numbers() const { return numbers_; }
  [[nodiscard]] bool valid() const { return family_->valid(numbers_); }
  [[nodiscard]] std::string type() const { return family_->type(numbers_); }
  [[nodiscard]] std::string identifier() const { return family_->identifier(numbers_); }

  template <format_bits Bits>
  [[nodiscard]] constexpr bool is() const {
    return family_ == &family_of<Bits>;
  }
  /// The numbers as the struct of their family; only where is<Bits>().
  template <format_bits Bits>
  [[nodiscard]] constexpr Bits as() const {
    return bits_of<Bits>(numbers_);
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

/// For those who have a format and no design. Throws std::runtime_error naming the text and what is allowed.
[[nodiscard]] Format parse_format(const FormatFamily& family, std::string_view text);
template <format_bits Bits>
[[nodiscard]] Bits parse_bits(std::string_view text) {
  return parse_format(family_of<Bits>, text).template as<Bits>();
}

}  // namespace hitpipe
