// A picture's rays through a core, cycle by cycle: whether its answers are software's, and how busy it was.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "sim/core/core_bench.hpp"
#include "sim/core/core_questions.hpp"
#include "sim/core/picture_rays.hpp"

namespace hitpipe::sim {

struct CoreTrace {
  int rays_in_flight = 1;
  int clock_ps = 0;
  std::optional<int> triangle_interval;  ///< none: a serial test has no fixed time
  CoreCounts counts;
  MemoryCounts memory;
  std::uint64_t wrong = 0;     ///< answers that are not software's
  bool same_reads = true;      ///< as many records and triangles as in software
  std::uint64_t restarts = 0;  ///< of the walks in software
  /// What a core with questions answered to them, asked by the same rays afterwards. The counts above leave that out.
  std::optional<QuestionTrace> questions{};

  /// Of the same core, with other rays.
  CoreTrace& operator+=(const CoreTrace& later);

  [[nodiscard]] bool right() const { return wrong == 0 && same_reads && (!questions || questions->right()); }
  [[nodiscard]] std::uint64_t blocks() const { return counts.records + counts.triangles; }
  [[nodiscard]] double a_ray(std::uint64_t count) const {
    return static_cast<double>(count) / static_cast<double>(counts.rays);
  }
  /// Percent of all cycles.
  [[nodiscard]] double cycles_pct(double count) const {
    return 100 * count / static_cast<double>(counts.cycles);
  }
  [[nodiscard]] double port_busy_pct() const { return cycles_pct(static_cast<double>(blocks())); }
  [[nodiscard]] double bytes_a_ray() const { return a_ray(memory.bytes_read); }
  [[nodiscard]] double mrays_s() const { return 1e6 / clock_ps / a_ray(counts.cycles); }
};

/// Makes the numbers of blocks and the addresses of a core long enough for an image.
void make_room(rtl::CoreOptions& options, const ref::CoreImage& image);

/// How many lines a core's cache reads at a time, so that the memory is always busy: 8, or more for a memory whose
/// latency is long against the cycles of a line.
[[nodiscard]] int lines_for(const MemoryOptions& memory);

/// `machine` has the core's ports, and `picture` has a ray. `answered` gets the core's answers, by job. Throws
/// as CoreBench does.
[[nodiscard]] CoreTrace trace_core(const rtl::Core& core, rtl::NativeMachine& machine,
                                   const ref::CoreImage& image, const PictureRays& picture,
                                   const MemoryOptions& memory,
                                   const std::function<void(double)>& progress = {},
                                   const std::function<void(std::span<const CoreAnswer>)>& answered = {});

/// The same of a core with questions, with other rays than a picture's. All counts are of these questions.
[[nodiscard]] CoreTrace trace_core(const rtl::Core& core, rtl::NativeMachine& machine,
                                   const ref::CoreImage& image, const ref::IntScene& scene,
                                   std::span<const ref::Ray> rays, const MemoryOptions& memory,
                                   const QuestionOptions& questions);

}  // namespace hitpipe::sim
