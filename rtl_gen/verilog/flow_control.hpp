// Whether a pipeline can wait.
#pragma once

#include <array>
#include <string_view>

namespace hitpipe::rtl {

enum class FlowControl {
  stall,  ///< valid and ready on both sides: while a result waits, the whole pipeline stands still
  none,   ///< valid alone: a test may go in every cycle, and its result comes out `latency` cycles later
};
/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 2> flow_control_names{"stall", "none"};

[[nodiscard]] constexpr std::string_view flow_control_name(FlowControl flow) {
  return flow_control_names[static_cast<std::size_t>(flow)];
}

}  // namespace hitpipe::rtl
