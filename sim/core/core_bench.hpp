// A core (docs/core.md) with a memory in front of it: rays go in, blocks are read, answers come out. The core
// is software (native_core.hpp) or Verilog; both give the same in every cycle.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hls/machines/cache.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/failure.hpp"
#include "hls/machines/weights.hpp"
#include "rays/image/core_image.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/int_triangle.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "sim/core/line_bus.hpp"
#include "sim/core/memory_model.hpp"
#include "sim/core/port_places.hpp"
#include "sim/core/ring_bus.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

struct CoreJob {
  ref::Ray ray;
  bool any = false;   ///< any hit will do
  bool none = false;  ///< the core is told that it is no ray
  /// Of a core with questions: the next crossing that is not before `from_t` and `from_number`, or with `any` the
  /// count of crossings.
  bool once = false;
  std::int64_t from_t = 0;
  std::uint32_t from_number = 0;
};
/// What int_triangle says of the hit (hls/world/triangle_operands.hpp).
struct CoreWeights {
  ref::Int128 det = 0, u = 0, v = 0;
};
struct CoreAnswer {
  ref::IntHit hit;  ///< t is the ray's length where nothing is hit
  hls::Failure failed = hls::not_failed;
  std::optional<CoreWeights> weights{};  ///< of a core that gives them
};

/// Rays may want crossings.
[[nodiscard]] inline bool has_questions(const rtl::Core& core) {
  return core.place_of(hls::channels::ray_once).has_value();
}
/// Answers say where in its triangle a ray hits.
[[nodiscard]] inline bool has_weights(const rtl::Core& core) {
  return core.place_of(hls::weights::HitDet::high).has_value();
}

/// The job's ray as the core is given it: the ports ray_any to ray_length or ray_len, in their order. Throws
/// as ref::int_ray() does where the core takes integers. What is none has a length of NaN where it takes floats.
[[nodiscard]] std::vector<rtl::Word> ray_fields(const rtl::Core& core, const CoreJob& job);

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

struct CoreBenchOptions {
  std::uint32_t most_steps = (1U << 20) - 1;  ///< records that a ray may test, 1 or more
  std::uint64_t base = 0;                     ///< the image's address, divided by 64
  int held_percent = 0;                       ///< of all cycles take no answer, at random, 0..99
  int gap_percent = 0;                        ///< of all cycles begin to offer no ray, at random, 0..99
  std::uint64_t blocks = 0;                   ///< that the image is said to have; 0: as many as it has
  int wild_percent = 0;                       ///< of all rays have other numbers in some fields, 0..100
  /// Twice as many rays are offered as the core has room for, with any tags; most_rays grows from few to its largest
  /// number; answers wait for long; and ports have random words while they say nothing.
  bool unruly = false;
  int most_lines = 8;  ///< that a core with a cache reads at a time, 1..63
  std::uint64_t seed = 1;
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
  [[nodiscard]] int answer_bits() const { return core_.answer_bits(); }
  /// Of all runs.
  [[nodiscard]] const CoreCounts& counts() const { return counts_; }
  /// With a cache of the core's own, requests are its rays', hits and merged ones are the cache's.
  [[nodiscard]] MemoryCounts memory_counts() const;

 private:
  /// The rays in flight, for run_rays(). A ray's place is its tag.
  class World;

  [[nodiscard]] std::vector<rtl::Word> fields_of(const CoreJob& job);
  /// One of those that are the place, modulo the number of places.
  rtl::Word tag_of(std::size_t place, std::size_t places);
  void spoil(std::vector<rtl::Word>& fields);
  void put_random(std::size_t place, std::size_t count);
  void change_settings();
  void show_block();
  void show_beat();
  /// `asks` and `answers` say what the core offers; `asked`: memory took a request.
  void check_alive(bool asks, bool asked, bool answers);
  void count_idle(double room, double begun, double reading);
  [[nodiscard]] CoreWeights weights() const;

  const rtl::Core& core_;
  rtl::NativeMachine& machine_;
  CoreBenchOptions options_;
  MemoryModel memory_;
  std::uint64_t most_still_, most_blocks_;  ///< cycles without a request, and blocks, between two answers
  std::uint64_t still_ = 0, blocks_ = 0;
  using OfCache =
      hls::Join<hls::List<hls::channels::asks, hls::channels::asks_triangle>, hls::channels::Asks::Back,
                hls::channels::Beat, hls::channels::Beat::Back, hls::List<hls::cache::beat_id>,
                hls::channels::CacheSettings, hls::channels::CacheEvents>;
  using Places =
      PortPlaces<hls::Join<hls::List<hls::channels::ray_valid, hls::channels::ray_ready,
                                     hls::channels::ray_tag, hls::channels::ray_any>,
                           hls::channels::Hits, hls::channels::Hits::Back, hls::channels::Request,
                           hls::channels::Request::Back, hls::channels::BlockRead, hls::channels::Settings,
                           hls::weights::HitWeights, OfCache, hls::List<hls::channels::ray_begins>>>;
  Places at_;
  ref::adversary::Random random_;
  std::vector<rtl::Word> inputs_, outputs_;
  std::vector<int> widths_;  ///< of the inputs
  std::optional<MemoryAnswer> block_;
  std::optional<LineBus> bus_;    ///< of a core with a cache
  std::optional<RingBus> rings_;  ///< of a core with rings
  CoreCounts counts_;
};

}  // namespace hitpipe::sim
