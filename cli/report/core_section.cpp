#include "cli/report/core_section.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

namespace hitpipe::cli {

namespace {

/// What core.csv has beyond that, the page leaves to it.
std::vector<Row> shown_rows(const CoreFacts& core) {
  std::vector<Row> rows = core.rows;
  for (Row& row : rows)
    for (const char* const left : {"rays", "reads_a_ray", "restarts_a_ray", "pair_busy_pct", "refused_pct",
                                   "idle_memory_pct", "idle_inside_pct", "idle_few_rays_pct", "command"})
      row.erase(left);
  return rows;
}

}  // namespace

void add_core_section(Page& page, const ReportFacts& facts) {
  const CoreFacts& core = facts.core;
  page.heading("The core");
  if (!core.why_not.empty()) {
    page.paragraph("The core has not traced this scene: " + core.why_not + ".");
    return;
  }
  page.paragraph(
      "A core walks the hierarchy by itself: it is given rays and memory, and gives hits. Cores of two "
      "formats "
      "traced a small picture of the scene cycle by cycle, with memories of several kinds, and every answer "
      "was compared with software. The port can take a block of 32 bytes in each cycle. All figures are in "
      "core.csv, each row with the command that makes it.");
  std::uint64_t answers = 0;
  for (const CoreResult& result : core.results) answers += result.trace.counts.rays;
  const auto number = [](std::uint64_t count) { return readable_number(std::to_string(count)); };
  page.list({{"Picture", fmt::format("{} x {} pixels, {} rays", core.width, core.height,
                                     number(core.results.front().trace.counts.rays))},
             {"Must be none", fmt::format("wrong answers {} of {}, rows with other reads than software's {}",
                                          number(core.wrong()), number(answers), core.other_reads())}});
  for (const Diagrammed& d : facts.core_diagrams) page.plot(d.picture, d.caption);
  page.table(page_table("What cores did with the rays of the picture: core.csv.", shown_rows(core)));
}

}  // namespace hitpipe::cli
