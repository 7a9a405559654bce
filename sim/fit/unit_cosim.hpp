// Co-simulation of a unit as it is, whole or cut: its own Verilog answers, and its rays and operands are
// checked against what it demands.
#pragma once

#include "sim/cosim.hpp"
#include "sim/fit/written_unit.hpp"

namespace hitpipe::sim {

/// As read_unit() would read what `hitpipe rtl` writes of the design.
[[nodiscard]] WrittenUnit whole_unit(const rtl::Design& design, rtl::Format format,
                                     const rtl::Library& library,
                                     rtl::FlowControl flow = rtl::FlowControl::stall);

/// With as many ray slots, the unit is behind a memory of rays. Throws as VerilatedDesign and
/// rtl::ray_slots() do, and std::invalid_argument, one line, for ray slots before a unit without flow
/// control.
[[nodiscard]] VerilatedDesign verilate(const rtl::Design& design, const WrittenUnit& unit,
                                       std::optional<int> ray_slots = {});

/// The unit says which coarse axes, ends of rays and guard there are, whatever `options` say of them. Throws
/// as cosimulate() does, and std::out_of_range, one line, for a scene that does not keep to the unit's
/// demands.
[[nodiscard]] CosimResult cosimulate_unit(const rtl::Design& design, const WrittenUnit& unit,
                                          const VerilatedDesign& verilated, const ref::Scene& scene,
                                          const ref::Bvh& bvh, const CosimOptions& options);

}  // namespace hitpipe::sim
