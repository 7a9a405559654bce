// Integers in bytes whose first has the lowest weight.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hitpipe::ref {

template <class Unsigned>
[[nodiscard]] Unsigned little_endian(const char* from) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
    value |= std::uint64_t{static_cast<unsigned char>(from[i])} << 8U * i;
  return static_cast<Unsigned>(value);
}

}  // namespace hitpipe::ref
