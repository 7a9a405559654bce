#include "sim/operands/traced_list.hpp"

#include <algorithm>
#include <cstddef>

#include "host/parallel.hpp"
#include "rays/exact/exact_triangle.hpp"

namespace hitpipe::sim {

TracedList trace_list(const ref::Tracer& tracer, std::span<const AskedRay> rays, int threads,
                      const std::function<void(double)>& progress) {
  constexpr std::size_t part = 1024;
  TracedList traced;
  traced.triangles.resize(rays.size(), ref::Hit::none);
  for (const ref::Query query : {ref::Query::closest, ref::Query::any}) {
    std::vector<ref::Ray> asked;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (rays[i].query != query) continue;
      asked.push_back(rays[i].ray);
      places.push_back(i);
    }
    std::vector<std::uint32_t> triangles(asked.size());
    std::vector<ref::TraceCounts> counts((asked.size() + part - 1) / part);
    const auto trace_part = [&](std::size_t i) {
      const std::size_t size = std::min(part, asked.size() - i * part);
      tracer.trace(
          {std::span(asked).subspan(i * part, size), query, std::span(triangles).subspan(i * part, size)},
          counts[i]);
    };
    host::for_each_index(counts.size(), threads, trace_part, progress);
    for (const ref::TraceCounts& each : counts)
      traced.counts.of(query == ref::Query::any ? ref::RayKind::shadow : ref::RayKind::primary) += each;
    for (std::size_t i = 0; i < places.size(); ++i) traced.triangles[places[i]] = triangles[i];
  }
  return traced;
}

std::uint64_t different_answers(std::span<const AskedRay> rays, std::span<const std::uint32_t> triangles,
                                std::span<const std::uint32_t> exact) {
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    different += ref::same_answer(rays[i].query, triangles[i], exact[i]) ? 0 : 1;
  }
  return different;
}

}  // namespace hitpipe::sim
