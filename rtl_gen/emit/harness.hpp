// A C++ program that drives the unit as Verilator compiles it, for engineers to start their own from. It
// replays the vectors as the testbench does, without hitpipe.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::rtl {

/// Sends the `count` vectors of tb/<module>_vectors.hex with gaps and stalls, and compares every result and
/// every tag. Prints "PASS <n> vectors" and returns 0, or prints "FAIL" with the reason and returns 1. With a
/// `fixed_latency` the unit has no ready, as in testbench().
[[nodiscard]] std::string harness(const std::string& module, const std::vector<Port>& ports,
                                  const std::vector<hls::Result>& results, int count,
                                  std::optional<int> fixed_latency = {});

}  // namespace hitpipe::rtl
