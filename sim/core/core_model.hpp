// The traversal core in software, cycle by cycle: its machines (hls/machines) as they are in Verilog, joined
// by the same wires, in front of a memory with latency. The units are pipelines of fixed latency here, and
// the door gives a ray every few cycles. It says what a core answers, in how many cycles, and what it waited
// for.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "hls/box/major_format.hpp"
#include "hls/world/world_format.hpp"
#include "sim/core/memory_model.hpp"
#include "sw_ref/core/core_image.hpp"
#include "sw_ref/world/int_ray.hpp"
#include "sw_ref/world/int_triangle.hpp"

namespace hitpipe::sim {

struct CoreModelOptions {
  hls::WorldBits world{};
  hls::MajorBits boxes{20, 1, 11, 0, 20};  ///< in a format with S, of the same world
  int rays = 128;                          ///< in flight, 1..256
  int stack_bits = 3;                      ///< a ray's stack has 2^stack_bits places, 1..6
  int levels = ref::CoreImage::most_levels;
  int address_bits = 24;                      ///< of a block's number
  std::uint32_t most_steps = (1U << 20) - 1;  ///< records that a ray may test, 1 or more
  // In cycles.
  int door_interval = 8;      ///< from one new ray to the next
  int pair_latency = 14;      ///< from a record to the results of its boxes
  int triangle_latency = 36;  ///< from the beginning of a triangle's test to its results
  int triangle_interval = 4;  ///< from one triangle's test to the next
};

struct CoreJob {
  ref::IntRay ray;
  bool any = false;  ///< any hit will do
};
struct CoreAnswer {
  ref::IntHit hit;  ///< t is the ray's length where nothing is hit
  bool failed = false;
};

struct CoreCounts {
  std::uint64_t rays = 0, cycles = 0;
  std::uint64_t records = 0, triangles = 0;  ///< blocks that were read
  std::uint64_t hits = 0;                    ///< that were divided
  std::uint64_t failed = 0;
  /// Cycles in which the port was given no request: with too few rays in flight all of them wait for memory
  /// or for a unit; the memory may have refused one.
  std::uint64_t idle = 0, refused = 0;
};

namespace core_parts {
class Machines;
}

class CoreModel {
 public:
  /// The image must outlive it. Throws std::invalid_argument, one line, for formats that do not go together
  /// and as MemoryModel does.
  CoreModel(const ref::CoreImage& image, const CoreModelOptions& options, const MemoryOptions& memory);
  ~CoreModel();

  /// Answers the jobs, each at its place. Throws std::logic_error when the core is silent for too long.
  /// `progress` gets the share that is done, 0 to 1, from time to time.
  void run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
           const std::function<void(double)>& progress = {});
  /// Of all runs.
  [[nodiscard]] const CoreCounts& counts() const;
  [[nodiscard]] const MemoryCounts& memory_counts() const;

 private:
  std::unique_ptr<core_parts::Machines> machines_;
};

}  // namespace hitpipe::sim
