// A piece of work whose parts do not depend on each other, so that many machines can share it
// (docs/choosing.md).
#pragma once

#include <cstdint>

namespace hitpipe::host {

struct Piece {
  std::uint64_t number = 1;  ///< 1..of
  std::uint64_t of = 1;

  struct Range {
    std::uint64_t first = 0;
    std::uint64_t end = 0;

    [[nodiscard]] std::uint64_t size() const { return end - first; }
  };
  /// The piece's share of so many parts, at most 2^63 / of. All pieces together have each part once, in
  /// order, and their sizes differ by one at most.
  [[nodiscard]] constexpr Range range(std::uint64_t parts) const {
    return {parts * (number - 1) / of, parts * number / of};
  }

  static constexpr std::uint64_t most = 1'000'000;

  friend bool operator==(const Piece&, const Piece&) = default;
};

}  // namespace hitpipe::host
