// The price of parts that are joined: of each machine and unit of a core, of the machines of its bus, and their sum.
// Bits of memories are apart, as those of a machine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"

namespace hitpipe::area {

struct CorePartPrice {
  std::int64_t memory_bits = 0;
  std::int64_t area_um2 = 0;
  rtl::ChipCells taken{};

  CorePartPrice& operator+=(const CorePartPrice& more);
  friend CorePartPrice operator+(CorePartPrice a, const CorePartPrice& b) { return a += b; }
};

struct CorePrice {
  std::vector<CorePartPrice> parts;  ///< in the order of the parts
  CorePartPrice all;                 ///< their sum
};

/// Throws as area::price() of machines and pipelines.
[[nodiscard]] CorePrice price(std::span<const rtl::Part> parts, const rtl::Library& library);
[[nodiscard]] inline CorePrice price(const rtl::Core& core, const rtl::Library& library) {
  return price(core.parts, library);
}

}  // namespace hitpipe::area
