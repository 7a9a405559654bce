// The proof of the result FIFO around a unit without flow control.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"

namespace hitpipe::formal {

/// A stand-in for the unit, and its wrapper with properties. The stand-in has what is proved of such a unit:
/// what goes in at an edge comes out `latency` edges later. Its result is the bit of its operands that the
/// tag names. The properties are inductive after a reset:
///   each test comes out once, in order, with its tag and its result, and stays until it is taken
///   the oldest test is there `latency` edges after it was taken, or when the one before it has gone
///   no result arrives at a full FIFO
///   whenever the consumer is ready, the wrapper takes a test in the next cycle
/// With an interval of more than one cycle the stand-in is ready once in the interval, and the wrapper takes
/// a test then if the consumer was ready once since the stand-in was ready last.
[[nodiscard]] std::string fifo_proof(const std::string& unit, const std::vector<rtl::Port>& operands,
                                     int latency, int interval = 1);

}  // namespace hitpipe::formal
