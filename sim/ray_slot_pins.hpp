// The write port of a unit behind ray slots, in the C++ that wraps its Verilated module.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/emit/ray_slots.hpp"
#include "sim/model_source.hpp"

namespace hitpipe::sim {

/// `operands` are those of the whole design.
[[nodiscard]] MorePins ray_slot_pins(const rtl::RaySlots& slots, const std::vector<rtl::Port>& operands);

}  // namespace hitpipe::sim
