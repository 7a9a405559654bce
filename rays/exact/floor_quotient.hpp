// A quotient of integers of 128 bits as a double, rounded down: the same bits from every compiler.
#pragma once

namespace hitpipe::ref {

__extension__ typedef unsigned __int128 Uint128;

/// The largest double that is not above numerator / denominator. The numerator is below 2^124, and the denominator is
/// 1..2^122.
[[nodiscard]] double floor_quotient(Uint128 numerator, Uint128 denominator);

}  // namespace hitpipe::ref
