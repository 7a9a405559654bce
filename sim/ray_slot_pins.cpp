#include "sim/ray_slot_pins.hpp"

#include <fmt/format.h>

namespace hitpipe::sim {

MorePins ray_slot_pins(const rtl::RaySlots& slots, const std::vector<rtl::Port>& operands) {
  return {
      .drive = fmt::format(R"(  top.ray_valid = pins->rays != nullptr && pins->rays->valid;
  if (pins->rays != nullptr) top.in_slot = pins->rays->in_slot;
  if (top.ray_valid) {{
    const std::int64_t* const ray = pins->rays->operands;
    top.ray_slot = pins->rays->slot;
{}{}{}  }}
)",
                           slots.end.empty() ? "" : "    top.ray_end_only = pins->rays->end_only;\n",
                           drive_lines(slots.line, operands, "ray"), drive_lines(slots.end, operands, "ray")),
      .read = "  if (pins->rays != nullptr) pins->rays->ready = top.ray_ready;\n"};
}

}  // namespace hitpipe::sim
