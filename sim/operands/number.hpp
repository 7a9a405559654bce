// Numbers as a user writes them: decimal (-0.25, 1e-3) or in C's hexadecimal form (-0x1p-2). Infinities and
// NaN are no numbers.
#pragma once

#include <optional>
#include <string_view>

namespace hitpipe::sim {

enum class Rounding { down, up };

/// The nearest double, which is infinite beyond the largest; nothing if the word is no number.
[[nodiscard]] std::optional<double> read_double(std::string_view word);
/// The nearest binary32. `word` must be a number.
[[nodiscard]] float nearest_binary32(std::string_view word);
/// The nearest double on this side of the number. `word` must be a number.
[[nodiscard]] double read_double(std::string_view word, Rounding side);

/// The nearest binary32 on this side of a sum of two doubles. The sum is exact, |rest| is at most an ulp of
/// `most` and most is within the range of binary32.
[[nodiscard]] float to_binary32(double most, double rest, Rounding side);

}  // namespace hitpipe::sim
