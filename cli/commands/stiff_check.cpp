#include "cli/commands/stiff_check.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/report/python.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/kept.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "host/files.hpp"
#include "rays/scene/scene.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::cli {

template <>
struct Kept<sim::StiffBoxes> {
  static void each(auto& boxes, const auto& member) {
    member("log2_ratio", boxes.stiffness);
    member("half_side", boxes.half_side);
    member("aimed", boxes.aimed);
    member("tests", boxes.tests);
    member("exact_hits", boxes.hits);
    member("false_hits", boxes.false_hits);
    member("false_misses", boxes.false_misses);
  }
};

template <>
struct Kept<sim::StiffTraversals> {
  static void each(auto& traversals, const auto& member) {
    member("log2_ratio", traversals.stiffness);
    member("rays", traversals.rays);
    member("box_tests", traversals.box_tests);
    member("reference_box_tests", traversals.reference_box_tests);
    member("different_triangles", traversals.different_triangles);
    member("work_sums", traversals.work);
  }
};

namespace {

constexpr std::size_t most_formats = 8;  // a table has 80 columns

struct CountedScene {
  ref::Scene scene;
  ref::Bvh bvh;
};

void measure(const StiffCheck& command, const CountedScene* loaded, std::vector<MeasuredDesign>& designs) {
  for (MeasuredDesign& d : designs) {
    for (Measured& m : d.formats) {
      Progress progress(fmt::format("{} {}", d.design->name, to_string(m.format)));
      const double parts = loaded != nullptr ? 2.0 : 1.0;
      double finished = 0;
      const sim::StiffnessOptions options{
          .tests = command.tests,
          .rays = command.rays,
          .seed = command.seed,
          .threads = command.threads,
          .progress = [&](double share) { progress.show((finished + share) / parts); }};
      m.boxes = sim::stiff_boxes([&] { return sim::make_box_test(*d.design, m.format); }, options);
      m.all_boxes = sim::over_all_kinds(m.boxes);
      if (loaded == nullptr) continue;
      finished = 1;
      m.traversals = sim::stiff_traversals(*d.design, m.format, loaded->scene.mesh, loaded->bvh, options);
    }
  }
}

void write(const std::vector<Row>& rows, const StiffReport& report) {
  const std::string table = table_text(rows, OutputFormat::csv);
  std::vector<host::File> files = stiffness_pictures(report.drawer, table, report.width_mm);
  files.push_back({"stiffness.csv", table});
  files.push_back({metadata_file("stiffness.csv").string(),
                   csv_metadata({csv_table("stiffness.csv", table)}, report.notes)});
  host::write_files(report.out, files);
}

/// Takes away the formats that the piece does not have.
void keep(std::vector<MeasuredDesign>& designs, host::Piece::Range mine) {
  std::uint64_t place = 0;
  for (MeasuredDesign& design : designs)
    std::erase_if(design.formats, [&](const Measured&) {
      const bool kept = place >= mine.first && place < mine.end;
      ++place;
      return !kept;
    });
  std::erase_if(designs, [](const MeasuredDesign& design) { return design.formats.empty(); });
}

void append(std::vector<MeasuredDesign>& designs, const rtl::Design* design, Measured measured) {
  if (designs.empty() || designs.back().design != design) designs.push_back({design, {}});
  designs.back().formats.push_back(std::move(measured));
}

}  // namespace

StiffFindings& StiffFindings::operator+=(StiffFindings later) {
  for (MeasuredDesign& each : later.designs)
    for (Measured& measured : each.formats) append(designs, each.design, std::move(measured));
  return *this;
}

std::vector<MeasuredDesign> stiff_designs(const StiffCheck& command) {
  const auto own = [](const rtl::Design& design) { return sim::stiffness_formats(design); };
  std::vector<const rtl::Design*> designs = command.units.designs(sim::why_not_traced);
  if (command.units.names.empty())
    std::erase_if(designs, [](const rtl::Design* design) { return !design->conservative; });
  std::vector<MeasuredDesign> measured;
  for (const sim::DesignFormats& each : command.units.formats(designs, own)) {
    if (each.formats.size() > most_formats)
      throw CLI::ValidationError("--bits", fmt::format("{} formats for {}; allowed are {} at most",
                                                       each.formats.size(), each.design->name, most_formats));
    MeasuredDesign made{each.design, {}};
    for (const Format& format : each.formats)
      made.formats.push_back({.format = format, .boxes = {}, .all_boxes = {}, .traversals = {}});
    measured.push_back(std::move(made));
  }
  return measured;
}

std::uint64_t stiff_formats(const std::vector<MeasuredDesign>& designs) {
  std::uint64_t count = 0;
  for (const MeasuredDesign& design : designs) count += design.formats.size();
  return count;
}

StiffFindings check_stiff_rays(const StiffCheck& command, std::vector<MeasuredDesign> designs,
                               host::Piece piece) {
  keep(designs, piece.range(stiff_formats(designs)));
  StiffFindings findings{.scene = {}, .hierarchy = {}, .mesh = Row::object(), .designs = std::move(designs)};
  std::optional<CountedScene> loaded;
  if (!command.scene.name.empty()) {
    const Progress progress("reading the scene");
    loaded.emplace(CountedScene{command.scene.load(), {}});
    loaded->bvh = ref::make_hierarchy(loaded->scene, command.hierarchy).bvh;
    findings.scene = loaded->scene.name;
    findings.hierarchy = command.hierarchy.text();
    findings.mesh = scene_row(loaded->scene);
  }
  measure(command, loaded ? &*loaded : nullptr, findings.designs);
  return findings;
}

void to_json(Row& row, const StiffFindings& findings) {
  row = {{"scene", findings.scene}, {"hierarchy", findings.hierarchy}, {"mesh", findings.mesh}};
  Row& formats = row["formats"] = Row::array();
  for (const MeasuredDesign& each : findings.designs)
    for (const Measured& measured : each.formats)
      formats.push_back({{"design", each.design->name},
                         {"bits", to_string(measured.format)},
                         {"boxes", measured.boxes},
                         {"traversals", measured.traversals}});
}

void from_json(const Row& row, StiffFindings& findings) {
  row.at("scene").get_to(findings.scene);
  row.at("hierarchy").get_to(findings.hierarchy);
  findings.mesh = row.at("mesh");
  for (const Row& each : row.at("formats")) {
    const rtl::Design& design = rtl::find_design(each.at("design").get<std::string>());
    Measured measured{.format = design.parse_format(each.at("bits").get<std::string>()),
                      .boxes = each.at("boxes").get<std::vector<sim::StiffBoxes>>(),
                      .all_boxes = {},
                      .traversals = each.at("traversals").get<std::vector<sim::StiffTraversals>>()};
    measured.all_boxes = sim::over_all_kinds(measured.boxes);
    append(findings.designs, &design, std::move(measured));
  }
}

int report_findings(const StiffFindings& findings, const StiffReport& report) {
  const std::vector<MeasuredDesign>& designs = findings.designs;
  std::vector<Row> rows = stiffness_rows(designs, findings.scene);
  if (!report.out.empty()) write(rows, report);
  if (report.format == OutputFormat::json)
    for (Row& row : rows) row.update(findings.mesh);
  fmt::print("{}", report.format == OutputFormat::text ? stiffness_text(designs, findings.scene)
                                                       : table_text(rows, report.format));
  if (report.format == OutputFormat::text && !findings.hierarchy.empty())
    fmt::print("hierarchy: {}\nscene: {}\n", findings.hierarchy, summary_of(findings.mesh));
  const std::uint64_t wrong = wrong_answers(designs);
  if (wrong == 0) return 0;
  fmt::print(stderr,
             "hitpipe: {} false misses or different triangles of designs that never miss; all must be 0\n",
             wrong);
  return 1;
}

}  // namespace hitpipe::cli
