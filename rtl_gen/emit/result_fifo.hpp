// A FIFO for the results of a unit without flow control: the module <unit>_fifo contains the emitted module
// and has valid and ready on both sides. The unit itself never waits. The wrapper counts credits: the FIFO
// has a place for every test that is in flight or waits as a result, and in_ready is low while all places are
// taken. So nothing is lost, whatever the consumer does. in_ready follows from registers alone.
#pragma once

#include <string>

#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// Places of the FIFO behind a unit of this latency that takes a test every `interval` cycles. A test holds
/// its place for latency + 1 cycles, and for interval - 1 cycles more where the consumer is ready once in an
/// interval. In that time the unit takes latency / interval + 1 tests, and the next one finds a place too.
/// With one place less it would wait, and such a consumer would get fewer results than the unit can give.
[[nodiscard]] constexpr int fifo_places(int latency, int interval) {
  return latency / interval + 2;
}

/// The flow control of the unit in a wrapper that can be around either, if the user does not say. A FIFO
/// costs more than the enables that it saves when its places have more than a quarter as many bits as the
/// unit has latches: docs/flow.md has the figures.
[[nodiscard]] FlowControl wrapped_flow_control(const Pipeline& pipeline);

/// The name of the wrapper of a unit's module.
[[nodiscard]] std::string fifo_module(const std::string& module);
/// The pins of the wrapper: the unit's, and both ready.
[[nodiscard]] ModuleInterface fifo_interface(const ModuleInterface& unit);
/// The wrapper in Verilog-2001, without the unit's module. Throws as check_names() does.
[[nodiscard]] std::string result_fifo(const ModuleInterface& unit, int latency);
/// The object result_fifo of a manifest: module, file, places, the width of a place, ports.
[[nodiscard]] Json fifo_json(const ModuleInterface& unit, int latency);

}  // namespace hitpipe::rtl
