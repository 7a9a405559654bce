#include "cli/text/trace_text.hpp"

#include <cstdint>
#include <utility>

#include "cli/text/kept.hpp"

namespace hitpipe::cli {

template <>
struct Kept<sim::QuestionTrace> {
  static void each(auto& questions, const auto& member) {
    member("question_rays", questions.rays);
    member("crossings", questions.crossings);
    member("ties", questions.ties);
    member("nearests", questions.nearests);
    member("anys", questions.anys);
    member("counts", questions.counts);
    member("nexts", questions.nexts);
    member("outside_rays", questions.outside);
    member("odd_counts", questions.odd);
    member("questions_wrong", questions.wrong);
  }
};

template <>
struct Kept<CoreRun> {
  static void each(auto& run, const auto& member) {
    auto& trace = run.trace;
    member("core", run.core);
    member("rays", trace.counts.rays);
    member("cycles", trace.counts.cycles);
    member("records", trace.counts.records);
    member("triangles", trace.counts.triangles);
    member("failed", trace.counts.failed);
    member("refused", trace.counts.refused);
    member("few_rays", trace.counts.few_rays);
    member("waiting", trace.counts.waiting);
    member("inside", trace.counts.inside);
    member("memory_cycles", trace.memory.cycles);
    member("requests", trace.memory.requests);
    member("outside", trace.memory.outside);
    member("hits", trace.memory.hits);
    member("misses", trace.memory.misses);
    member("merged", trace.memory.merged);
    member("bytes_read", trace.memory.bytes_read);
    member("answers", trace.memory.answers);
    member("most_waiting", trace.memory.most_waiting);
    member("wrong", trace.wrong);
    member("same_reads", trace.same_reads);
    member("restarts", trace.restarts);
    member("rays_in_flight", trace.rays_in_flight);
    member("clock_ps", trace.clock_ps);
    member("triangle_interval", trace.triangle_interval);
    member("questions", trace.questions);
  }
};

Row kept_runs(const std::vector<CoreRun>& runs, Row about) {
  about["runs"] = runs;
  return about;
}

std::vector<CoreRun> parse_runs(const Row& row) {
  return row.at("runs").get<std::vector<CoreRun>>();
}

Row trace_row(const sim::CoreTrace& trace, bool cache) {
  const sim::CoreCounts& counts = trace.counts;
  const auto pct = [&](std::uint64_t cycles) { return trace.cycles_pct(static_cast<double>(cycles)); };
  Row row{{"rays_in_flight", trace.rays_in_flight},
          {"rays", counts.rays},
          {"wrong", trace.wrong},
          {"reads_a_ray", trace.a_ray(trace.blocks())},
          {"restarts_a_ray", trace.a_ray(trace.restarts)},
          {"bytes_a_ray", trace.bytes_a_ray()},
          {"cycles_a_ray", trace.a_ray(counts.cycles)},
          {"mrays_s", trace.mrays_s()},
          {"port_busy_pct", trace.port_busy_pct()},
          {"pair_busy_pct", pct(counts.records)}};
  if (trace.triangle_interval)
    row["triangle_busy_pct"] = pct(counts.triangles * static_cast<std::uint64_t>(*trace.triangle_interval));
  row.update(Row{{"refused_pct", pct(counts.refused)},
                 {"idle_memory_pct", trace.cycles_pct(counts.waiting)},
                 {"idle_inside_pct", trace.cycles_pct(counts.inside)},
                 {"idle_few_rays_pct", trace.cycles_pct(counts.few_rays)}});
  if (trace.questions)
    row.update(Row{{"nearests", trace.questions->nearests},
                   {"anys", trace.questions->anys},
                   {"counts", trace.questions->counts},
                   {"nexts", trace.questions->nexts},
                   {"crossings", trace.questions->crossings},
                   {"ties", trace.questions->ties},
                   {"questions_wrong", trace.questions->wrong}});
  if (cache)
    row["cache_hits_pct"] =
        100 * static_cast<double>(trace.memory.hits) / static_cast<double>(trace.memory.requests);
  return row;
}

Row edge_row(const sim::CoreTrace& trace, bool closed, OutputFormat format) {
  const sim::QuestionTrace& found = trace.questions.value();
  return {{"rays_in_flight", trace.rays_in_flight},
          {"rays", found.rays},
          {"wrong", found.wrong},
          {"crossings", found.crossings},
          {"ties_settled", found.ties},
          {"closed", format == OutputFormat::json ? Row(closed) : Row(closed ? "yes" : "no")},
          {"outside_rays", found.outside},
          {"odd_counts", found.odd},
          {"nearests", found.nearests},
          {"anys", found.anys},
          {"counts", found.counts},
          {"nexts", found.nexts},
          {"reads_an_answer", trace.a_ray(trace.blocks())},
          {"cycles_an_answer", trace.a_ray(trace.counts.cycles)},
          {"port_busy_pct", trace.port_busy_pct()}};
}

std::vector<Row> turned(const std::vector<Row>& rows) {
  std::vector<Row> lines;
  for (const auto& [key, first] : rows.front().items()) {
    if (key == "rays_in_flight") continue;
    Row line{{"rays in flight", key}};
    for (const Row& row : rows) line[row.at("rays_in_flight").dump()] = row.at(key);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace hitpipe::cli
