// FNV-1a with 64 bits (Fowler, Noll, Vo). It names contents; it does not protect against forgery.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hitpipe::host {

inline constexpr std::uint64_t fnv1a_start = 0xcbf29ce484222325U;

/// Continues from the hash of what comes before.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::span<const std::byte> bytes,
                                            std::uint64_t before = fnv1a_start) {
  std::uint64_t hash = before;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3U;
  return hash;
}

}  // namespace hitpipe::host
