#include "cli/report/report_sections.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "area_model/figure.hpp"

namespace hitpipe::cli {

namespace {

/// The columns of rows.csv that the page shows.
const std::vector<std::string> shown_columns{"design",
                                             "bits",
                                             "boxes_per_test",
                                             "stages",
                                             "stage_delay_ns",
                                             "area_mm2",
                                             "area_per_box_mm2",
                                             "box_tests",
                                             "false_hits_per_million",
                                             "extra_box_tests_per_ray",
                                             "extra_triangle_tests_per_ray",
                                             "cycles",
                                             "occupancy_pct",
                                             "run_time_ms",
                                             "area_run_time_mm2_ms",
                                             "false_misses",
                                             "rtl_mismatches",
                                             "different_triangles",
                                             "different_pixels"};

using Rows = std::span<const sim::SweepRow>;

/// The line of rows.csv that holds this row. The file starts with a comment and the header.
std::size_t line_of(std::size_t row) {
  return row + 3;
}

std::string readable_cell(const sim::SweepRow& row, const std::string& column) {
  return readable_number(cell(row, column));
}

/// The cells of rows, formatted for readers.
PageTable page_table(const std::string& caption, const std::vector<Row>& rows) {
  PageTable table{caption, {}, {}};
  if (rows.empty()) return table;
  for (const auto& [key, value] : rows.front().items()) table.columns.push_back(key);
  for (const Row& row : rows) {
    std::vector<std::string> cells;
    for (const auto& [key, value] : row.items())
      cells.push_back(value.is_null()     ? ""
                      : value.is_string() ? value.get<std::string>()
                                          : readable_number(value.dump()));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

PageTable sweep_table(Rows rows, int rays) {
  PageTable table{
      fmt::format("{} rays in flight. The first column is the line of rows.csv from which the numbers "
                  "come; that file has further columns and all their digits.",
                  rays),
      {"line"},
      {}};
  table.columns.insert(table.columns.end(), shown_columns.begin(), shown_columns.end());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].rays_in_flight != rays) continue;
    std::vector<std::string> cells{std::to_string(line_of(row))};
    for (const std::string& column : shown_columns) cells.push_back(readable_cell(rows[row], column));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// A line for each unit, a column for each number of rays in flight.
PageTable occupancy_table(Rows rows) {
  std::map<int, int> column_of;
  std::vector<std::string> names;
  for (std::size_t row = 0; row < rows.size(); ++row) column_of[rows[row].rays_in_flight] = 0;
  PageTable table{"Occupancy in percent (occupancy_pct of rows.csv) by rays in flight.", {"unit"}, {}};
  for (auto& [rays, column] : column_of) {
    column = static_cast<int>(table.columns.size());
    table.columns.push_back(std::to_string(rays));
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const sim::SweepRow& unit = rows[row];
    const std::string name = unit_name(unit);
    auto line = std::find_if(table.rows.begin(), table.rows.end(),
                             [&](const std::vector<std::string>& cells) { return cells.front() == name; });
    if (line == table.rows.end()) {
      table.rows.emplace_back(table.columns.size()).front() = name;
      line = table.rows.end() - 1;
    }
    (*line)[static_cast<std::size_t>(column_of[unit.rays_in_flight])] =
        readable_cell(rows[row], "occupancy_pct");
  }
  // A unit measured with only one number of rays has nothing to show here.
  std::erase_if(table.rows, [](const std::vector<std::string>& cells) {
    return std::count_if(cells.begin() + 1, cells.end(), [](const std::string& c) { return !c.empty(); }) < 2;
  });
  return table;
}

/// The row of the unit with the least area × run time, among those with few extra box tests.
std::optional<std::size_t> cheapest(Rows rows, int rays, double most_extra_pct) {
  std::optional<std::size_t> best;
  const auto price = [&](std::size_t row) { return rows[row].area_run_time_mm2_ms(); };
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const sim::SweepRow& unit = rows[row];
    if (unit.rays_in_flight != rays || extra_box_tests_pct(unit) > most_extra_pct) continue;
    if (!best || price(row) < price(*best)) best = row;
  }
  return best;
}

void add_findings(Page& page, const ReportFacts& facts, int rays) {
  const Rows rows = facts.rows;
  const Wrong wrong = wrong_in(rows);
  std::uint64_t box_tests = 0;
  for (const sim::SweepRow& row : rows) box_tests += row.box_tests;
  std::vector<std::pair<std::string, std::string>> findings{
      {"Rows", fmt::format("{}, {} box tests", rows.size(), readable_number(std::to_string(box_tests)))},
      {"Must be none",
       fmt::format("false misses of integer units {}, RTL answers unlike the C++ {}, different "
                   "triangles {}, different pixels {}",
                   wrong.false_misses, wrong.rtl_mismatches, wrong.different_triangles,
                   wrong.different_pixels)}};
  const auto told = [&](std::size_t row) {
    const int boxes = rows[row].boxes_per_test;
    return fmt::format("{}: {} mm²{}, {} ms, {} mm² ms (line {} of rows.csv)", unit_name(rows[row]),
                       readable_cell(rows[row], "area_mm2"),
                       boxes == 1 ? "" : fmt::format(" for {} boxes in a test", boxes),
                       readable_cell(rows[row], "run_time_ms"),
                       readable_cell(rows[row], "area_run_time_mm2_ms"), line_of(row));
  };
  for (const double percent : {0.1, 1.0, 10.0}) {
    if (const auto row = cheapest(rows, rays, percent)) {
      findings.emplace_back(fmt::format("Least area × run time, at most {:g} % extra box tests", percent),
                            told(*row));
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const sim::SweepRow& unit = rows[row];
    if (unit.design == area::yardstick().design && unit.rays_in_flight == rays)
      findings.emplace_back("The yardstick", told(row));
  }
  page.list(findings);
}

std::vector<std::string> commands_of(const ReportFacts& facts) {
  std::vector<std::string> lines{"# This page", facts.command, "# The rows"};
  lines.insert(lines.end(), facts.row_commands.begin(), facts.row_commands.end());
  lines.emplace_back("# The pictures");
  for (const Row& row : facts.pictures.rows) lines.push_back(row.at("command").get<std::string>());
  lines.insert(lines.end(), {"# The pipelines", "hitpipe area --format csv", "# Stability"});
  for (const Stability& s : facts.stability) lines.push_back(s.command);
  lines.emplace_back("# The schematics");
  for (const rtl::Design& design : rtl::designs())
    lines.push_back(fmt::format("hitpipe rtl {} --out FOLDER", design.name));
  return lines;
}

}  // namespace

std::vector<Row> pipeline_rows(const ReportFacts& facts) {
  std::vector<Row> rows;
  const auto yardstick = std::find_if(facts.prices.begin(), facts.prices.end(), [](const area::Price& p) {
    return p.design == area::yardstick().design;
  });
  for (const area::Price& p : facts.prices) {
    rows.push_back(
        {{"design", p.design},
         {"bits", rtl::to_string(p.format)},
         {"stages", p.stages},
         {"stage_delay_ns", area::delay_ns(p.stage_delay_ps)},
         {"clock_mhz", area::clock_mhz(p)},
         {"latency_ns", area::delay_ns(p.latency_ps())},
         {"area_mm2", area::area_mm2(p.area_um2)},
         {"area_pct", area::percent(p.area_per_box_um2(), yardstick->area_per_box_um2())},
         {"area_delay_mm2_ns", area::adp_mm2_ns(p)},
         {"area_delay_pct", area::percent(p.area_delay_per_box(), yardstick->area_delay_per_box())}});
  }
  return rows;
}

std::vector<Row> stability_rows(const ReportFacts& facts) {
  std::vector<Row> rows;
  for (const Stability& s : facts.stability) {
    rows.push_back({{"design", s.design},
                    {"bits", s.bits},
                    {"tests", s.tests},
                    {"seed", facts.seed},
                    {"hits", s.hits},
                    {"false_misses", s.false_misses},
                    {"false_hits", s.false_hits}});
  }
  return rows;
}

std::string report_html(const ReportFacts& facts) {
  const Rows rows = facts.rows;
  const int rays = usual_rays_in_flight(rows);
  Page page("hitpipe: which box test for " + facts.scene + "?");
  page.paragraph(
      "Every unit below traced the same rays through the same hierarchy, each of its box tests answered by "
      "its Verilog. Error is what a unit does in vain: box and triangle tests beyond those of a software "
      "traversal in floats. Run time is clock cycles, as counted, times the stage delay. Area is compared "
      "for each box that a unit tests in a cycle.");

  page.heading("What was asked");
  page.commands({facts.command});
  page.list(facts.asked);

  page.heading("What was found");
  add_findings(page, facts, rays);

  page.heading("Error against cost");
  page.paragraph(
      "Up: extra box tests above the reference, robust float slabs in software, 0.0001 to 1000 %; a unit "
      "that makes none, or fewer, lies at 0.0001, and what is beyond an axis on its end. The axes are the "
      "same for every scene. Filled and labelled: the six units of Table 7.2; hollow: other formats. No unit "
      "lies below and left of the dashed front.");
  for (const Drawing& d : facts.diagrams) page.plot(d.svg, d.alternative, d.caption);

  page.heading("Images");
  page.pictures(facts.pictures.images);
  page.heading("Where the work is");
  page.pictures(facts.pictures.maps);
  page.table(page_table("The pictures' numbers: pictures.csv.", facts.pictures.rows));

  page.heading("Pipelines");
  page.table(
      page_table("The six units of Table 7.2, all that is emitted priced by its component library; percent "
                 "of fp_slabs for each box: pipelines.csv.",
                 pipeline_rows(facts)));

  page.heading("The sweep");
  if (std::any_of(rows.begin(), rows.end(),
                  [](const sim::SweepRow& row) { return row.boxes_per_test > 1; })) {
    page.paragraph(
        "A unit that answers for two boxes in a test is compared as two units: its area per box is half of "
        "its area. Area × run time takes the whole area, because such a unit needs fewer cycles for its "
        "boxes.");
  }
  page.table(sweep_table(rows, rays));
  const PageTable occupancy = occupancy_table(rows);
  if (!occupancy.rows.empty()) page.table(occupancy);

  page.heading("Stability");
  page.paragraph(
      "Rays and boxes made to break box tests, judged by exact arithmetic on boxes that are not padded. An "
      "integer unit may accept too much, and must never miss. Shares say nothing about a scene.");
  page.table(page_table("stability.csv.", stability_rows(facts)));

  page.heading("Schematics");
  if (facts.schematics.empty()) page.paragraph("Not drawn: Graphviz was not installed.");
  for (const Schematic& schematic : facts.schematics) {
    page.open(schematic.title);
    for (const Drawing& d : schematic.drawings) page.drawing(d.svg, d.alternative, d.caption);
    page.close();
  }

  page.heading("To repeat it");
  page.paragraph("No number but a time depends on threads or machine. Seeds are those of the commands.");
  page.commands(commands_of(facts));
  page.heading("Versions");
  std::vector<std::pair<std::string, std::string>> made_by = versions();
  made_by.insert(made_by.begin(), {"Program", facts.version});
  page.list(made_by);
  return page.html();
}

}  // namespace hitpipe::cli
