// A core (docs/core.md) with a memory in front of it: rays go in, blocks are read, answers come out. The core
// is software (native_core.hpp) or Verilog; both give the same in every cycle.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "rays/image/core_image.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "sim/core/block_port.hpp"
#include "sim/core/core_pins.hpp"
#include "sim/core/memory_model.hpp"
#include "sim/core/ray_fields.hpp"
#include "sim/core/ray_port.hpp"

namespace hitpipe::sim {

struct CoreCounts {
  std::uint64_t rays = 0, cycles = 0;
  std::uint64_t records = 0, triangles = 0;  ///< blocks that were read
  std::uint64_t failed = 0;
  std::uint64_t refused = 0;          ///< cycles in which memory, or the core's cache, took no request
  std::uint64_t hits = 0, joins = 0;  ///< blocks whose line was in the core's cache, and that was on its way
  /// Cycles in which the core asked for nothing. Each is divided by where the rays were that it has room for:
  /// there were none for it, they waited for memory, or they were in its queues and units.
  double few_rays = 0, waiting = 0, inside = 0;

  CoreCounts& operator+=(const CoreCounts& later);
};

class CoreBench {
 public:
  /// `machine` has the core's ports; it, the image and the core must outlive this. Resets the machine. Throws
  /// std::invalid_argument, one line, when the core's numbers of blocks are too short for the image, and as
  /// MemoryModel does.
  CoreBench(const rtl::Core& core, rtl::NativeMachine& machine, const ref::CoreImage& image,
            const MemoryOptions& memory, const CoreBenchOptions& options = {});

  /// Answers the jobs, each at its place. Throws std::logic_error when the core answers a ray that it does
  /// not have, and when it stands still: it neither asks nor answers in more cycles than its parts can take,
  /// or asks for more blocks between two answers than its rays can need in this scene. `progress` gets the
  /// share that is done, 0 to 1, from time to time.
  void run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
           const std::function<void(double)>& progress = {});
  /// Of the T of an answer.
  [[nodiscard]] int answer_bits() const { return pins_.core.answer_bits(); }
  /// Of all runs.
  [[nodiscard]] CoreCounts counts() const;
  /// With a cache of the core's own, requests are its rays', hits and merged ones are the cache's.
  [[nodiscard]] MemoryCounts memory_counts() const;

 private:
  /// The rays in flight, for run_rays(). A ray's place is its tag.
  class World;

  /// `asks` and `answers` say what the core offers; `asked`: memory took a request.
  void check_alive(bool asks, bool asked, bool answers);
  void count_idle(double room, double begun, double reading);

  rtl::NativeMachine& machine_;
  CorePins pins_;
  std::unique_ptr<BlockPort> blocks_;
  std::unique_ptr<RayPort> rays_;
  std::uint64_t most_still_, most_blocks_;  ///< cycles without a request, and blocks, between two answers
  std::uint64_t still_ = 0, read_since_ = 0;
  CoreCounts counts_;
};

}  // namespace hitpipe::sim
