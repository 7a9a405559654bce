#include "cli/commands/world_sweep.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "area_model/price.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "host/files.hpp"
#include "sim/cosim/counts.hpp"
#include "sw_ref/world/int_error.hpp"

namespace hitpipe::cli {

namespace {

/// What a unit costs, and how long it is busy with so many tests.
void add_cost(Row& row, const std::string& unit, const area::Price& price, std::uint64_t tests) {
  if (price.taken.luts > 0) {
    row[unit + "_lut"] = price.taken.luts;
  } else {
    row[unit + "_area_mm2"] = static_cast<double>(price.area_um2) * 1e-6;
  }
  row[unit + "_ms"] = static_cast<double>(tests) * static_cast<double>(price.test_ps()) * 1e-9;
}

std::vector<Row> rows_of(const WorldSweep& command, const ref::Scene& scene, const Format& format) {
  const auto world = format.as<hls::WorldBits>();
  const rtl::Design& box_unit = rtl::find_design("int_major");
  ref::IntErrorOptions options{.world = world,
                               .boxes = {},
                               .width = command.scene.width,
                               .height = command.scene.height,
                               .light = command.light,
                               .hierarchy = command.hierarchy};
  for (const int p : command.mantissas)
    options.boxes.push_back({world.coord, world.finer, p, 0, world.slope});
  const ref::IntError error = ref::int_error(scene, options);
  const auto price = [&](const rtl::Design& design, const Format& its_format) {
    return area::price(design, its_format, *command.library, area::Account::built, rtl::FlowControl::stall,
                       command.interval);
  };
  const area::Price triangle_price = price(*command.design, format);
  const ref::Share rays = error.different(), pixels{error.different_pixels, error.pixels};
  std::vector<Row> rows;
  for (std::size_t i = 0; i < options.boxes.size(); ++i) {
    const Format boxes = options.boxes[i];
    const ref::TraceCounts& work = error.with[i];
    Row row{
        {"scene", scene.name},
        {"hierarchy", command.hierarchy.name()},
        {"bits", to_string(format)},
        {"boxes", to_string(boxes)},
        {"rays", error.rays},
        {"different_rays", error.different_rays},
        {"different_rays_pct", rays.percent()},
        {"different_rays_pct_low", rays.percent_interval().low},
        {"different_rays_pct_high", rays.percent_interval().high},
        {"lost_hits", error.lost_hits},
        {"pixels", error.pixels},
        {"different_pixels", error.different_pixels},
        {"different_pixels_pct", pixels.percent()},
        {"different_pixels_pct_low", pixels.percent_interval().low},
        {"different_pixels_pct_high", pixels.percent_interval().high},
        {"largest_difference", error.largest_difference},
        {"triangles", error.triangles},
        {"degenerate_dropped", scene.mesh.without_area},
        {"lost_to_rounding", scene.mesh.lost() + error.lost_to_rounding},
        {"mesh_share_of_cube_pct", 100.0 * scene.mesh_part},
        {"largest_movement", error.largest_movement},
        {"extra_box_tests_pct", sim::percent_above(work.box_tests, error.exact.box_tests)},
        {"extra_triangle_tests_pct", sim::percent_above(work.triangle_tests, error.exact.triangle_tests)}};
    add_cost(row, "box", price(box_unit, boxes), work.box_tests);
    add_cost(row, "triangle", triangle_price, work.triangle_tests);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string text_of(const std::vector<Row>& rows) {
  std::string text =
      "bits        p   rays other  pixels  largest    extra % extra %   area    busy\n"
      "                %            other  movement   boxes   triangles box+tri ms\n";
  for (const Row& row : rows) {
    const auto number = [&](const char* name) { return row.at(name).get<double>(); };
    const std::string boxes = row.at("boxes").get<std::string>();
    const std::size_t slash = boxes.find('/') + 1;
    const bool on_chip = row.contains("box_lut");
    const std::string area =
        on_chip ? fmt::format("{:.0f}", number("box_lut") + number("triangle_lut"))
                : fmt::format("{:.2f}", number("box_area_mm2") + number("triangle_area_mm2"));
    text += fmt::format("{:<11} {:<3} {:<12.4f} {:<7} {:<10.2e} {:<7.2f} {:<9.2f} {:<7} {:.3f}\n",
                        row.at("bits").get<std::string>(),
                        boxes.substr(slash, boxes.find_first_not_of("0123456789", slash) - slash),
                        number("different_rays_pct"), row.at("different_pixels").get<std::uint64_t>(),
                        number("largest_movement"), number("extra_box_tests_pct"),
                        number("extra_triangle_tests_pct"), area, number("box_ms") + number("triangle_ms"));
  }
  return text;
}

/// The rows of the sweep: for each format and each p, what the bits change and cost.
std::vector<Row> world_rows(const WorldSweep& command, const ref::Scene& scene,
                            const std::function<void(double)>& progress) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < command.formats.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(command.formats.size()));
    for (Row& row : rows_of(command, scene, command.formats[i])) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<Format> usual_world_formats() {
  std::vector<Format> formats;
  for (const int n : {16, 18, 20, 22, 24}) formats.emplace_back(hls::WorldBits{n, 1, n});
  return formats;
}

WorldFindings sweep_world(const WorldSweep& command, Row notes) {
  std::optional<Progress> progress("reading the scene");
  const ref::Scene scene = command.scene.load();
  progress.emplace("sweeping");
  notes.update(camera_notes(scene));
  return {.head = fmt::format("{}, {} x {}, {}, {}", scene.name, command.scene.width, command.scene.height,
                              summary_of(scene_row(scene)), command.hierarchy.text()),
          .rows = world_rows(command, scene, [&](double share) { progress->show(share); }),
          .notes = std::move(notes)};
}

Row to_row(const WorldFindings& findings) {
  return {{"head", findings.head}, {"rows", findings.rows}, {"notes", findings.notes}};
}

WorldFindings parse_world_findings(const Row& row) {
  return {.head = row.at("head").get<std::string>(),
          .rows = row.at("rows").get<std::vector<Row>>(),
          .notes = row.at("notes")};
}

int report_world(const WorldFindings& findings, const std::string& out, OutputFormat format) {
  const std::filesystem::path file = out;
  const std::string table = table_text(findings.rows, OutputFormat::csv);
  host::write_file(file, table);
  host::write_file(metadata_file(file), csv_metadata({csv_table(file, table)}, findings.notes));
  fmt::print("{}", format == OutputFormat::text ? findings.head + "\n" + text_of(findings.rows)
                                                : table_text(findings.rows, format));
  return 0;
}

}  // namespace hitpipe::cli
