// The price of a core: of each machine and unit in it, and of all of them. Bits of memories are apart, as
// those of a machine.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"

namespace hitpipe::area {

struct CorePartPrice {
  std::int64_t memory_bits = 0;
  std::int64_t area_um2 = 0;
  rtl::ChipCells taken{};
};

struct CorePrice {
  std::vector<CorePartPrice> parts;  ///< in the order of the core's
  CorePartPrice all;                 ///< their sum
};

/// Throws as area::price() of machines and pipelines.
[[nodiscard]] CorePrice price(const rtl::Core& core, const rtl::Library& library);

}  // namespace hitpipe::area
