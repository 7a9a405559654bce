// Memories by their figures, which `hitpipe core trace --memory` names: built-in ones and files.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rtl_gen/core/core.hpp"
#include "sim/core/memory_model.hpp"

namespace hitpipe::sim {

/// What a memory's port takes, in cycles of the core's clock.
struct MemoryPort {
  int least_latency = 100, most_latency = 100;  ///< from a request to its answer, 1..10,000
  int beat_bytes = 32;                          ///< that the port gives at a time, a power of two, 1..64
  int beat_cycles = 1;                          ///< from beat to beat, 1..100
  int burst_cycles = 0;                         ///< that each read takes besides its beats, 0..1,000
  DramRows rows{};                              ///< what a read takes besides
  int refused_percent = 0;                      ///< of all cycles in which it takes no request, 0..99

  /// From one read of so many bytes to the next.
  [[nodiscard]] int cycles_of(int bytes) const;
};

struct KnownMemory {
  std::string_view name;
  std::string_view what;
  MemoryPort port;
};

[[nodiscard]] std::span<const KnownMemory> known_memories();
/// What a memory's figures are called, with commas between them.
[[nodiscard]] std::string figure_names();

/// "dram", "memory.json", or one of them with other figures: "ideal,latency=1..200". A file is a JSON object with
/// some of the figures. Its latency is a number, or an array of the least and the most. Figures that it does not
/// name are those of `ideal`. Throws std::runtime_error, one line.
[[nodiscard]] MemoryPort memory_port(const std::string& text);

/// The memory as a core sees it through its bus. It has no cache, but the core may have one.
[[nodiscard]] MemoryOptions memory_behind(const MemoryPort& port, const rtl::CoreOptions& core);

}  // namespace hitpipe::sim
