// Verilog with the properties that yosys-smtbmc proves about a clocked module. docs/formal.md says how they
// make up the whole claim.
#pragma once

#include <string>

#include "rtl_gen/verilog/module_interface.hpp"
#include "tests/formal/component.hpp"

namespace hitpipe::formal {

/// Module "flow": from any state, `edges` enabled edges after its operands came, a component shows the result
/// of its combinational form.
[[nodiscard]] std::string component_flow(const Component& component);
/// The same for a design, from input ports to HIT and tag, while the pipeline moves. With an interval of more
/// than one cycle the operands come when in_ready is high.
[[nodiscard]] std::string design_flow(const rtl::Pipeline& pipeline, const std::string& design,
                                      rtl::FlowControl flow);
/// Properties to add at the end of a design's own module: the handshake, and that valid bits and tags move as
/// in a plain shift register. With an interval of more than one cycle: the phase is the number of moves since
/// the reset, modulo the interval, and a test is in a stage in the phase of that stage alone. They hold after
/// reset and are inductive.
[[nodiscard]] std::string control_properties(const rtl::Pipeline& pipeline, rtl::FlowControl flow);
/// Module "stalled": from any state, a test taken now comes out after as many moves as there are stages, with
/// its own tag and the HIT of the combinational design. It stays until it is taken, whatever valid, ready and
/// the operands of other tests do. Only of a design that stalls.
[[nodiscard]] std::string stalled_design(const rtl::Pipeline& pipeline, const std::string& design);

}  // namespace hitpipe::formal
