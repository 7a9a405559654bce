#include "sim/core/core_trace.hpp"

#include <algorithm>
#include <vector>

namespace hitpipe::sim {

void make_room(rtl::CoreOptions& options, const ref::CoreImage& image) {
  while (image.blocks.size() > std::uint64_t{1} << options.address_bits) ++options.address_bits;
  options.byte_bits = std::max(options.byte_bits, options.address_bits + 5);
}

CoreTrace& CoreTrace::operator+=(const CoreTrace& later) {
  counts += later.counts;
  memory += later.memory;
  wrong += later.wrong;
  same_reads = same_reads && later.same_reads;
  restarts += later.restarts;
  return *this;
}

CoreTrace trace_core(const rtl::Core& core, rtl::NativeMachine& machine, const ref::CoreImage& image,
                     const PictureRays& picture, const MemoryOptions& memory,
                     const std::function<void(double)>& progress,
                     const std::function<void(std::span<const CoreAnswer>)>& answered) {
  CoreBench bench(core, machine, image, memory);
  std::vector<CoreAnswer> answers(picture.jobs.size());
  bench.run(picture.jobs, answers, progress);
  if (answered) answered(answers);
  const CoreCounts& counts = bench.counts();
  return {.rays_in_flight = core.options.rays,
          .clock_ps = core.clock_ps,
          .triangle_interval =
              core.options.serial() ? std::nullopt : std::optional(core.options.triangle_interval),
          .counts = counts,
          .memory = bench.memory_counts(),
          .wrong = picture.wrong(answers),
          .same_reads = counts.records == picture.work.nodes_loaded &&
                        counts.triangles == picture.work.triangles_loaded,
          .restarts = picture.restarts};
}

}  // namespace hitpipe::sim
