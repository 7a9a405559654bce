#include "sim/core/core_trace.hpp"

#include <algorithm>
#include <vector>

namespace hitpipe::sim {

int lines_for(const MemoryOptions& memory) {
  constexpr int usual = 8, most = (1 << hls::channels::line_count_bits) - 1;
  return std::clamp(memory.most_latency / memory.line_interval + 2, usual, most);
}

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
  if (questions && later.questions) *questions += *later.questions;
  return *this;
}

namespace {

/// Of its unit; nothing if a machine tests triangles.
std::optional<int> triangle_interval(const rtl::Core& core) {
  for (const rtl::Part& part : core.parts)
    if (part.name == "triangle") return part.pipeline->interval();
  return std::nullopt;
}

/// What a bench has done so far.
CoreTrace traced_by(const rtl::Core& core, const CoreBench& bench) {
  return {.rays_in_flight = core.options.rays,
          .clock_ps = core.clock_ps,
          .triangle_interval = triangle_interval(core),
          .counts = bench.counts(),
          .memory = bench.memory_counts()};
}

}  // namespace

CoreTrace trace_core(const rtl::Core& core, rtl::NativeMachine& machine, const ref::CoreImage& image,
                     const PictureRays& picture, const MemoryOptions& memory,
                     const std::function<void(double)>& progress,
                     const std::function<void(std::span<const CoreAnswer>)>& answered) {
  CoreBench bench(core, machine, image, memory, {.most_lines = lines_for(memory)});
  std::vector<CoreAnswer> answers(picture.jobs.size());
  bench.run(picture.jobs, answers, progress);
  if (answered) answered(answers);
  CoreTrace trace = traced_by(core, bench);
  trace.wrong = picture.wrong(answers);
  trace.same_reads = trace.counts.records == picture.work.nodes_loaded &&
                     trace.counts.triangles == picture.work.triangles_loaded;
  trace.restarts = picture.restarts;
  if (has_questions(core)) {
    std::vector<ref::Ray> rays;
    for (const CoreJob& job : picture.jobs) rays.push_back(job.ray);
    trace.questions = trace_questions(bench, picture.scene(), rays);
  }
  return trace;
}

CoreTrace trace_core(const rtl::Core& core, rtl::NativeMachine& machine, const ref::CoreImage& image,
                     const ref::IntScene& scene, std::span<const ref::Ray> rays, const MemoryOptions& memory,
                     const QuestionOptions& questions) {
  CoreBench bench(core, machine, image, memory, {.most_lines = lines_for(memory)});
  const QuestionTrace found = trace_questions(bench, scene, rays, questions);
  CoreTrace trace = traced_by(core, bench);
  trace.questions = found;
  return trace;
}

}  // namespace hitpipe::sim
