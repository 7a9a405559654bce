// A list of rays through a tracer, with the answers in the order of the list.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rays/trace/tracer.hpp"
#include "sim/operands/ray_list.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::sim {

struct TracedList {
  ref::RenderCounts counts;              ///< rays for any hit count as shadow rays, others as primary rays
  std::vector<std::uint32_t> triangles;  ///< by ray, as TraceJob::triangles
};

/// In parts, so that several threads have work. `progress` gets the finished share, 0..1, from any thread.
[[nodiscard]] TracedList trace_list(
    const ref::Tracer& tracer, std::span<const AskedRay> rays, int threads,
    const std::function<void(double)>& progress = [](double) {});

/// How many answers of a list differ: the triangle, or for any hit whether there is one.
[[nodiscard]] std::uint64_t different_answers(std::span<const AskedRay> rays,
                                              std::span<const std::uint32_t> triangles,
                                              std::span<const std::uint32_t> exact);

}  // namespace hitpipe::sim
