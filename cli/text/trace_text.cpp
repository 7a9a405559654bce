#include "cli/text/trace_text.hpp"

#include <cstdint>
#include <utility>

namespace hitpipe::cli {

namespace {

/// Calls add(name, count) for each count of a run.
template <class Trace, class Add>
void each_count(Trace& trace, const Add& add) {
  add("rays", trace.counts.rays);
  add("cycles", trace.counts.cycles);
  add("records", trace.counts.records);
  add("triangles", trace.counts.triangles);
  add("failed", trace.counts.failed);
  add("refused", trace.counts.refused);
  add("few_rays", trace.counts.few_rays);
  add("waiting", trace.counts.waiting);
  add("inside", trace.counts.inside);
  add("memory_cycles", trace.memory.cycles);
  add("requests", trace.memory.requests);
  add("outside", trace.memory.outside);
  add("hits", trace.memory.hits);
  add("misses", trace.memory.misses);
  add("merged", trace.memory.merged);
  add("bytes_read", trace.memory.bytes_read);
  add("answers", trace.memory.answers);
  add("most_waiting", trace.memory.most_waiting);
  add("wrong", trace.wrong);
  add("same_reads", trace.same_reads);
  add("restarts", trace.restarts);
  add("rays_in_flight", trace.rays_in_flight);
  add("clock_ps", trace.clock_ps);
}

template <class Trace, class Add>
void each_question(Trace& questions, const Add& add) {
  add("question_rays", questions.rays);
  add("crossings", questions.crossings);
  add("ties", questions.ties);
  add("nearests", questions.nearests);
  add("anys", questions.anys);
  add("counts", questions.counts);
  add("nexts", questions.nexts);
  add("outside_rays", questions.outside);
  add("odd_counts", questions.odd);
  add("questions_wrong", questions.wrong);
}

}  // namespace

Row kept_runs(const std::vector<CoreRun>& runs, Row about) {
  Row rows = Row::array();
  for (const CoreRun& run : runs) {
    Row row{{"core", run.core}};
    each_count(run.trace, [&](const char* name, const auto& value) { row[name] = value; });
    if (run.trace.triangle_interval) row["triangle_interval"] = *run.trace.triangle_interval;
    if (run.trace.questions)
      each_question(*run.trace.questions, [&](const char* name, const auto& value) { row[name] = value; });
    rows.push_back(std::move(row));
  }
  about["runs"] = std::move(rows);
  return about;
}

std::vector<CoreRun> parse_runs(const Row& row) {
  std::vector<CoreRun> runs;
  for (const Row& each : row.at("runs")) {
    CoreRun& run = runs.emplace_back();
    run.core = each.at("core").get<std::size_t>();
    each_count(run.trace, [&](const char* name, auto& value) { each.at(name).get_to(value); });
    if (each.contains("triangle_interval"))
      run.trace.triangle_interval = each.at("triangle_interval").get<int>();
    if (each.contains("questions_wrong"))
      each_question(run.trace.questions.emplace(),
                    [&](const char* name, auto& value) { each.at(name).get_to(value); });
  }
  return runs;
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
