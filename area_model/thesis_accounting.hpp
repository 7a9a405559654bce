// How Table 7.2 departs from the schematics that it prices. Each design states its own departures
// (rtl::Printed); docs/table-7-2.md says where and by how much. Two rules hold in every row, so no design
// states them: only latches, muxes, subtractors, multipliers and comparators have area (no valid bits, no
// tag), and each row is rounded before the total is taken.
#pragma once

#include "rtl_gen/catalogue/printed.hpp"
#include "rtl_gen/pipeline.hpp"

namespace hitpipe::area {

/// The width at which Table 7.2 prices a latch, or a component.
[[nodiscard]] int printed_latch_bits(const rtl::Graph& graph, const rtl::Register& latch,
                                     const rtl::Format& format, const rtl::Printed& printed);
[[nodiscard]] int printed_component_bits(const rtl::Graph& graph, rtl::NodeId node, const rtl::Format& format,
                                         const rtl::Printed& printed);

}  // namespace hitpipe::area
