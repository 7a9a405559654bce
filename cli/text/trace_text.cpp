#include "cli/text/trace_text.hpp"

#include <cstdint>

namespace hitpipe::cli {

Row trace_row(const rtl::Core& core, const sim::CoreTrace& trace, bool cache) {
  const sim::CoreCounts& counts = trace.counts;
  const auto pct = [&](std::uint64_t cycles) { return trace.cycles_pct(static_cast<double>(cycles)); };
  Row row{{"rays_in_flight", core.options.rays},
          {"rays", counts.rays},
          {"wrong", trace.wrong},
          {"reads_a_ray", trace.a_ray(trace.blocks())},
          {"restarts_a_ray", trace.a_ray(trace.restarts)},
          {"bytes_a_ray", trace.bytes_a_ray()},
          {"cycles_a_ray", trace.a_ray(counts.cycles)},
          {"mrays_s", trace.mrays_s(core.clock_ps)},
          {"port_busy_pct", trace.port_busy_pct()},
          {"pair_busy_pct", pct(counts.records)}};
  // A serial test has no fixed time.
  if (!core.options.serial())
    row["triangle_busy_pct"] =
        pct(counts.triangles * static_cast<std::uint64_t>(core.options.triangle_interval));
  row.update(Row{{"refused_pct", pct(counts.refused)},
                 {"idle_memory_pct", trace.cycles_pct(counts.waiting)},
                 {"idle_inside_pct", trace.cycles_pct(counts.inside)},
                 {"idle_few_rays_pct", trace.cycles_pct(counts.few_rays)}});
  if (cache)
    row["cache_hits_pct"] =
        100 * static_cast<double>(trace.memory.hits) / static_cast<double>(trace.memory.requests);
  return row;
}

}  // namespace hitpipe::cli
