// The number format of an integer ray-box unit: "n/t", as the thesis prints it (section 6.2.3), e.g. 24/24.
//   n  bits of a coordinate and of an inverse ray direction vector component (IRDVC), 6..32
//   t  bits kept of a distance product, whose significant width is 2n-1, 6..2n-1
#pragma once

namespace hitpipe::hls {

/// An integer format whose widths are known at run time. Valid: see `valid()`.
struct IntBits {
  static constexpr int min_coord = 6;
  static constexpr int max_coord = 32;
  static constexpr int min_interval = 6;
  /// Below the program's formats, for exhaustive tests: the proofs of sw_ref/quantise hold for these too.
  static constexpr int min_proved = 4;

  int coord = 20;     ///< n
  int interval = 24;  ///< t

  /// Width of a product of a coordinate difference and an IRDVC: |product| <= (2^(n-1)-1)^2 < 2^(2n-2).
  [[nodiscard]] constexpr int product() const { return 2 * coord - 1; }
  /// Low product bits that are dropped before distances are compared.
  [[nodiscard]] constexpr int trimmed() const { return product() - interval; }
  /// A format of the program.
  [[nodiscard]] constexpr bool valid() const {
    return proved() && coord >= min_coord && interval >= min_interval;
  }
  /// A format of the pipelines and the ray set-up.
  [[nodiscard]] constexpr bool proved() const {
    return coord >= min_proved && coord <= max_coord && interval >= min_proved && interval <= product();
  }
  friend constexpr bool operator==(const IntBits&, const IntBits&) = default;
};

/// The same as a type, for the pipelines: IntFormat<24, 24> is the thesis's "24/24".
template <int N, int T>
struct IntFormat {
  static constexpr IntBits bits{N, T};
  static_assert(bits.proved(), "n/t must have n in 4..32 and t in 4..2n-1");
  static constexpr int coord = N;
  static constexpr int interval = T;
  static constexpr int product = bits.product();
  static constexpr int trimmed = bits.trimmed();
};

}  // namespace hitpipe::hls
