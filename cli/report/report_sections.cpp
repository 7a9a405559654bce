#include "cli/report/report_sections.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "cli/report/core_section.hpp"
#include "cli/report/report_page.hpp"
#include "cli/report/sweep_rows.hpp"
#include "sw_ref/judge/interval.hpp"

namespace hitpipe::cli {

namespace {

/// The columns of rows.csv that the page shows, in two tables, because one would be wider than a screen.
std::vector<std::string> cost_columns(bool on_chip) {
  std::vector<std::string> columns{"boxes_per_test", "stages", "stage_delay_ns"};
  if (on_chip) {
    columns.insert(columns.end(), {"luts", "registers", "multiplier_blocks", "area_per_box_lut"});
  } else {
    columns.insert(columns.end(), {"area_mm2", "area_per_box_mm2"});
  }
  columns.insert(columns.end(),
                 {"occupancy_pct", "run_time_ms", on_chip ? "area_run_time_lut_ms" : "area_run_time_mm2_ms",
                  "whole_run_time_ms", on_chip ? "whole_area_run_time_lut_ms" : "whole_area_run_time_mm2_ms",
                  "set_up_run_time_ms", "energy_nj_per_ray"});
  return columns;
}
const std::vector<std::string> work_columns{"box_tests",
                                            "extra_box_tests_pct",
                                            "triangle_tests",
                                            "extra_triangle_tests_pct",
                                            "false_hits_per_million",
                                            "false_misses",
                                            "nodes_fetched",
                                            "bytes_per_ray",
                                            "bytes_per_ray_4kib",
                                            "bytes_per_ray_16kib",
                                            "bytes_per_ray_64kib"};

using Rows = std::span<const sim::SweepRow>;

/// The line of rows.csv that holds this row. The file starts with the header.
std::size_t line_of(std::size_t row) {
  return row + 2;
}

std::string readable_cell(const sim::SweepRow& row, const std::string& column) {
  return readable_number(cell(row, column));
}

PageTable sweep_table(const std::string& what, Rows rows, int rays, const std::vector<std::string>& shown) {
  PageTable table{
      fmt::format(
          "{}, with {} rays in flight. The last column is the line of rows.csv from which the numbers "
          "come; that file has further columns and all their digits.",
          what, rays),
      {"unit"},
      {}};
  for (const std::string& column : shown) table.columns.push_back(column_heading(column));
  table.columns.emplace_back("line");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].rays_in_flight != rays) continue;
    std::vector<std::string> cells{unit_name(rows[row])};
    for (const std::string& column : shown) cells.push_back(readable_cell(rows[row], column));
    cells.push_back(std::to_string(line_of(row)));
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

void add_findings(Page& page, const ReportFacts& facts, int rays) {
  const Rows rows = facts.rows;
  const Wrong wrong = wrong_in(rows);
  std::uint64_t box_tests = 0;
  for (const sim::SweepRow& row : rows) box_tests += row.box_tests;
  std::vector<std::pair<std::string, std::string>> findings{
      {"Rows", fmt::format("{}, {} box tests", rows.size(), readable_number(std::to_string(box_tests)))},
      {"Must be none",
       fmt::format("false misses of units that never miss {}, RTL answers unlike the C++ {}, different "
                   "triangles {}, different pixels {}",
                   wrong.false_misses, wrong.rtl_mismatches, wrong.different_triangles,
                   wrong.different_pixels)}};
  const auto told = [&](std::size_t row) {
    const int boxes = rows[row].boxes_per_test;
    const bool chip = rows[row].on_chip();
    return fmt::format("{}: {} {}{}; {} (line {} of rows.csv)", unit_name(rows[row]),
                       readable_cell(rows[row], chip ? "luts" : "area_mm2"), area_unit(rows[row]),
                       boxes == 1 ? "" : fmt::format(" for {} boxes in a test", boxes), cost_text(rows[row]),
                       line_of(row));
  };
  for (const NamedRow& best : best_rows(rows)) findings.emplace_back(best.name, told(best.row));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const sim::SweepRow& unit = rows[row];
    if (unit.design == area::baseline_design().design && unit.rays_in_flight == rays && unit.interval == 1)
      findings.emplace_back("The yardstick", told(row));
  }
  page.list(findings);
  page.paragraph(cost_caveat(rows.front()));
}

/// A share of cases in percent, and its 95 % interval.
struct Share {
  double percent = 0;
  double low = 0;
  double high = 0;
};

Share share_of(const ref::GroupedRatio& share) {
  const auto [low, high] = share.share_interval();
  return {100.0 * share.ratio(), 100.0 * low, 100.0 * high};
}
Share misses_of(const sim::CategoryResult& r) {
  return share_of(r.false_miss_share);
}
Share false_hits_of(const sim::CategoryResult& r) {
  return share_of(r.false_hit_share);
}

std::string share_text(const Share& s) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", s.percent, s.low, s.high);
}

/// A line for each category and one for all, a column for each unit.
PageTable category_table(const ReportFacts& facts, const std::string& caption,
                         Share (*share)(const sim::CategoryResult&)) {
  PageTable table{caption, {"category", "tests of each unit"}, {}};
  const std::vector<sim::CategoryResult>& first = facts.stability.front().categories;
  for (std::size_t i = 0; i <= first.size(); ++i) {
    const bool all = i == first.size();
    table.rows.push_back(
        {all ? "all" : std::string(first[i].category),
         readable_number(std::to_string(all ? facts.stability.front().all.tests : first[i].tests))});
    for (const Stability& s : facts.stability)
      table.rows.back().push_back(share_text(share(all ? s.all : s.categories[i])));
  }
  for (const Stability& s : facts.stability)
    table.columns.push_back(s.bits == "fp32" ? s.design : s.design + " " + s.bits);
  return table;
}

/// What the units that can miss did miss, with figures.
std::string misses_text(const ReportFacts& facts) {
  std::string text;
  for (const Stability& s : facts.stability) {
    if (rtl::find_design(s.design).conservative) continue;
    if (s.all.false_misses == 0) {
      text += fmt::format("{} missed none of {} boxes (95 % interval up to {:.2g} %). ", s.design,
                          readable_number(std::to_string(s.all.hits)), misses_of(s.all).high);
      continue;
    }
    const auto most =
        std::max_element(s.categories.begin(), s.categories.end(),
                         [](const auto& a, const auto& b) { return a.false_misses < b.false_misses; });
    text += fmt::format("{} missed {} of {} boxes; most of them, {} of {}, in \"{}\". ", s.design,
                        readable_number(std::to_string(s.all.false_misses)),
                        readable_number(std::to_string(s.all.hits)), most->false_misses, most->hits,
                        most->category);
  }
  return text;
}

std::vector<std::string> commands_of(const ReportFacts& facts) {
  std::vector<std::string> lines{"# This page", facts.command, "# The rows"};
  lines.insert(lines.end(), facts.row_commands.begin(), facts.row_commands.end());
  lines.emplace_back("# The pictures");
  for (const Row& row : facts.pictures.rows) lines.push_back(row.at("command").get<std::string>());
  lines.emplace_back("# The pipelines");
  lines.insert(lines.end(), facts.area_commands.begin(), facts.area_commands.end());
  lines.emplace_back("# Stability");
  for (const Stability& s : facts.stability) lines.push_back(s.command);
  lines.emplace_back("# Stiff rays");
  lines.push_back(facts.stiffness_command);
  lines.emplace_back("# The integer world");
  lines.push_back(facts.world_command);
  if (!facts.core.commands.empty()) lines.emplace_back("# The core");
  lines.insert(lines.end(), facts.core.commands.begin(), facts.core.commands.end());
  lines.emplace_back("# The schematics");
  for (const rtl::Design& design : rtl::designs())
    lines.push_back(fmt::format("hitpipe rtl {} --out FOLDER", design.name));
  return lines;
}

}  // namespace

std::vector<Row> pipeline_rows(const ReportFacts& facts) {
  std::vector<Row> rows;
  const auto baseline = std::find_if(facts.prices.begin(), facts.prices.end(), [](const area::Price& p) {
    return p.design == area::baseline_design().design;
  });
  for (const area::Price& p : facts.prices) {
    Row& row = rows.emplace_back(Row{{"design", p.design},
                                     {"bits", rtl::to_string(p.format)},
                                     {"interval", p.interval},
                                     {"boxes_per_test", p.boxes},
                                     {"stages", p.stages},
                                     {"stage_delay_ns", area::delay_ns(p.stage_delay_ps)},
                                     {"clock_mhz", area::clock_mhz(p)},
                                     {"latency_ns", area::delay_ns(p.latency_ps())}});
    if (p.taken.luts > 0) {
      row.update(
          {{"luts", p.taken.luts}, {"registers", p.taken.registers}, {"multiplier_blocks", p.taken.blocks}});
      continue;
    }
    const auto percent = [&](std::int64_t part, std::int64_t whole) {
      return baseline == facts.prices.end() ? Row(nullptr) : Row(area::percent(part, whole));
    };
    const area::Price& of = baseline == facts.prices.end() ? p : *baseline;
    row.update({{"area_mm2", area::area_mm2(p.area_um2)},
                {"area_pct", percent(p.area_per_box_um2(), of.area_per_box_um2())},
                {"area_delay_mm2_ns", area::adp_mm2_ns(p)},
                {"area_delay_pct", percent(p.area_delay_per_box(), of.area_delay_per_box())}});
  }
  return rows;
}

std::vector<Row> stability_rows(const ReportFacts& facts) {
  std::vector<Row> rows;
  const auto add = [&](const Stability& s, std::string_view category, const sim::CategoryResult& r) {
    const Share miss = misses_of(r);
    const Share hit = false_hits_of(r);
    rows.push_back({{"design", s.design},
                    {"bits", s.bits},
                    {"category", category},
                    {"tests", r.tests},
                    {"seed", facts.seed},
                    {"exact_hits", r.hits},
                    {"false_misses", r.false_misses},
                    {"false_miss_pct", miss.percent},
                    {"false_miss_pct_low", miss.low},
                    {"false_miss_pct_high", miss.high},
                    {"false_hits", r.false_hits},
                    {"false_hit_pct", hit.percent},
                    {"false_hit_pct_low", hit.low},
                    {"false_hit_pct_high", hit.high}});
  };
  for (const Stability& s : facts.stability)
    for (const sim::CategoryResult& r : s.categories) add(s, r.category, r);
  return rows;
}

std::string report_html(const ReportFacts& facts) {
  const Rows rows = facts.rows;
  const int rays = usual_rays_in_flight(rows);
  Page page("hitpipe: which box test for " + facts.scene + "?");
  page.paragraph(
      "Every unit below traced the same rays through the same hierarchy, each of its box tests answered by "
      "its Verilog. Error is extra work: the box and triangle tests that a unit makes beyond a software "
      "traversal in floats. Run time is clock cycles, as counted, times the clock period. Area is compared "
      "for each box that a unit tests in a cycle. The whole cost adds the triangle tests: a false "
      "hit is paid for there.");

  page.heading("What was asked");
  page.commands({facts.command});
  page.list(facts.asked);

  page.heading("What was found");
  add_findings(page, facts, rays);

  page.heading("Error against cost");
  page.paragraph(
      "Up: extra tests, above the reference, which is conservative float slabs in software. Axes end "
      "where the data does. Each mark has its formats beside it, as hitpipe list designs spells them, or "
      "the name of a design with one format. Formats of one design that cover one another share a label. "
      "Where marks of different designs do, the lower mark is larger and labels name designs too. No unit "
      "lies below and left of the dashed front. The first four diagrams count box tests alone, as the "
      "thesis does, the next two triangle tests too. A software time is the median of nine runs on the "
      "machine that this page names, the exact triangle tests included. The last one has the bytes that a "
      "ray reads from memory.");
  for (const Diagrammed& d : facts.diagrams) page.plot(d.picture, d.caption);

  page.heading("Images");
  page.pictures(facts.pictures.images);
  page.heading("Where the work is");
  page.pictures(facts.pictures.maps);
  for (const std::string& text : facts.pictures.not_drawn) page.paragraph(text);
  page.table(page_table("The pictures' numbers: pictures.csv.", facts.pictures.rows));

  page.heading("Pipelines");
  page.table(page_table(
      fmt::format("{} and those with the least cost under What was found. All that is emitted "
                  "is priced by the component library {}; percent of {} for each box: pipelines.csv.",
                  facts.named ? "The designs that were asked for" : "The units of Table 7.2",
                  rows.front().library, area::baseline_design().design),
      pipeline_rows(facts)));

  page.heading("The sweep");
  if (std::any_of(rows.begin(), rows.end(),
                  [](const sim::SweepRow& row) { return row.boxes_per_test > 1; })) {
    page.paragraph(
        "A unit that answers for two boxes in a test is compared as two units: its area per box is half of "
        "its area. Area × run time takes the whole area, because such a unit needs fewer cycles for its "
        "boxes.");
  }
  page.table(sweep_table("What the units cost", rows, rays, cost_columns(rows.front().on_chip())));
  page.table(sweep_table("What the units did", rows, rays, work_columns));
  const PageTable occupancy = occupancy_table(rows);
  if (!occupancy.rows.empty()) page.table(occupancy);

  page.heading("Stability");
  page.paragraph(
      "Rays and boxes made to break box tests, judged by exact arithmetic on boxes that are not padded. A "
      "unit "
      "that never misses may accept too much. Shares say nothing about a scene. Cases are drawn at random, "
      "so "
      "each share has its 95 % interval in brackets. All counts are in stability.csv.");
  page.paragraph(
      "What units miss that can miss, and why: " + misses_text(facts) +
      "Such a float unit rounds every difference and product to nearest. Where the ray starts or ends on "
      "the box, grazes an edge or a corner, or the box has no extent, entry, exit and length are "
      "closer together than that rounding, and it can change their order: the unit answers MISS. "
      "Where the ray starts in a plane that is parallel to it, 0 times infinity is NaN, which compares "
      "false. A unit that never misses rounds outward, so it can only accept too much. The picture loses "
      "nothing all the same, because the boxes of the hierarchy are padded.");
  page.table(category_table(facts, "False hits, % of the boxes that the ray misses (95 % interval).",
                            false_hits_of));

  page.heading("Stiff rays");
  page.paragraph(
      "A ray is stiff when the components of its direction differ by orders of magnitude. A unit that gives "
      "all "
      "three inverse components one scale has few bits left for some axes of such a ray, and accepts boxes "
      "in "
      "vain; it never misses one. The lines are the false hits of all kinds of box in stiffness.csv, in "
      "percent of "
      "the boxes that the ray misses; the file has the tests and the 95 % interval of each kind.");
  if (facts.stiffness_diagram) page.plot(facts.stiffness_diagram->picture, facts.stiffness_diagram->caption);

  page.heading("The integer world");
  page.paragraph(
      "Rays, boxes and triangles on a grid of integers, each triangle test exact. What the bits of the grid "
      "change is the error here: rays whose closest triangle is another one than in exact arithmetic on the "
      "float scene, and pixels that differ. Beside it stand extra tests of int_major with p = 11 beyond "
      "exact "
      "boxes, the area of both units, and for how long their tests keep them busy: integer_world.csv.");
  page.plot(facts.world_diagram.picture, facts.world_diagram.caption);
  std::vector<Row> world = facts.world;
  for (Row& row : world)
    for (const char* const counted : {"scene", "rays", "different_rays", "pixels", "different_pixels",
                                      "triangles", "degenerate_dropped", "mesh_share_of_cube_pct"})
      row.erase(counted);
  page.table(page_table("What the bits change and cost.", world));

  add_core_section(page, facts);

  page.heading("Schematics");
  if (facts.schematics.empty()) page.paragraph("Not drawn: Graphviz was not installed.");
  for (const Schematic& schematic : facts.schematics) {
    page.open(schematic.title);
    for (const Drawing& d : schematic.drawings) page.drawing(d.svg, d.alternative, d.caption);
    page.close();
  }

  page.heading("To repeat it");
  page.paragraph("No number but a time depends on threads or machine. The commands show their seeds.");
  page.commands(commands_of(facts));
  page.heading("Versions");
  std::vector<std::pair<std::string, std::string>> made_by = versions();
  made_by.insert(made_by.begin(), {"Program", facts.version});
  page.list(made_by);
  return page.html();
}

}  // namespace hitpipe::cli
