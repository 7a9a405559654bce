// The number format of a design: n/t bits of an integer unit, or binary32 of a float one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hls/box/int_format.hpp"

namespace hitpipe::rtl {

class Format {
 public:
  /// An integer format; implicit, as the n/t formats are the many.
  constexpr Format(hls::IntBits bits) : integer_(bits) {}
  constexpr Format(int coord, int interval) : integer_(hls::IntBits{coord, interval}) {}
  /// IEEE 754 binary32.
  [[nodiscard]] static constexpr Format fp32() { return Format(); }

  [[nodiscard]] constexpr bool is_float() const { return !integer_; }
  /// Only of an integer format.
  [[nodiscard]] constexpr hls::IntBits bits() const { return *integer_; }

  friend constexpr bool operator==(const Format&, const Format&) = default;

 private:
  constexpr Format() = default;

  std::optional<hls::IntBits> integer_;
};

/// "20/24", or "fp32".
[[nodiscard]] std::string to_string(Format format);

/// "20/24". Throws std::runtime_error naming the text and what is allowed.
[[nodiscard]] hls::IntBits parse_bits(std::string_view text);

}  // namespace hitpipe::rtl
