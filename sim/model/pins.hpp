// What a testbench and a Verilated design exchange in one clock cycle. Compiled into both sides of the shared
// library.
#pragma once

#include <cstdint>

namespace hitpipe::sim {

struct Pins {
  // Driven before the rising edge. A unit without flow control has no out_ready.
  bool rst = false;
  bool in_valid = false;
  bool out_ready = true;
  std::uint16_t in_tag = 0;
  // Seen before the rising edge, with the above applied.
  bool in_ready = false;  ///< always 1 of a unit without flow control
  bool out_valid = false;
  bool hit = false;  ///< of the first box
  std::uint16_t out_tag = 0;
  std::int64_t* results = nullptr;  ///< where to write all results, in the design's order; nowhere when null
};

/// The entry points of the library.
using CreateModel = void* (*)();
using DestroyModel = void (*)(void* model);
/// Applies operands (in port order; used when pins->in_valid) and pins, reads the outputs, then clocks once.
using CycleModel = void (*)(void* model, const std::int64_t* operands, Pins* pins);

}  // namespace hitpipe::sim
