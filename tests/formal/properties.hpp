// Verilog with the properties that yosys-smtbmc proves of a clocked module; docs/formal.md says how they make
// up the whole claim.
#pragma once

#include <string>

#include "tests/formal/component.hpp"

namespace hitpipe::formal {

/// Module "flow": from any state, `edges` enabled edges after its operands were there, a component shows
/// what its combinational form makes of them.
[[nodiscard]] std::string component_flow(const Component& component);
/// The same of a design, from input ports to HIT and tag, while in_ready is high.
[[nodiscard]] std::string design_flow(const rtl::Pipeline& pipeline, const std::string& design);
/// Properties to stand at the end of a design's own module: handshake, valid bits and tags in lock-step with
/// a plain shift register. True of reset and inductive.
[[nodiscard]] std::string control_properties(const rtl::Pipeline& pipeline);
/// Module "stalled": from any state, a test taken now comes out after as many moves as there are stages, with
/// its own tag and the HIT of the combinational design, and stays until it is taken, whatever valid, ready
/// and the other tests' operands do.
[[nodiscard]] std::string stalled_design(const rtl::Pipeline& pipeline, const std::string& design);

}  // namespace hitpipe::formal
