#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/design_options.hpp"
#include "cli/progress.hpp"
#include "cli/report_sections.hpp"
#include "cli/report_sweep.hpp"
#include "cli/scene_options.hpp"
#include "cli/table.hpp"
#include "cli/values.hpp"
#include "host/files.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

struct ReportCommand {
  SceneChoice scene;
  DesignChoice image{"int_slabs", {}};
  std::vector<std::string> bits;  ///< swept
  std::string rows;
  std::uint64_t tests = 20'000;
  std::uint64_t seed = 1;
  std::string out;
  Format format = Format::text;
};

/// As a shell takes it.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                          "0123456789_-+=./,:") == std::string::npos;
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The options that the user gave, as given; only those of the scene and of the picture, if so wanted.
std::string options_given(const CLI::App& command, bool scene_only) {
  std::string text;
  for (const CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    const bool of_scene = name != "--out" && name != "--rows" && name != "--bits" &&
                          !name.starts_with("--image-") && name != "--tests" && name != "--seed" &&
                          name != "--threads" && name != "--format";
    if (option->count() == 0 || (scene_only && !of_scene)) continue;
    for (const std::string& result : option->results())
      text += fmt::format("{}{} {}", text.empty() ? "" : " ", name, quoted(result));
  }
  return text;
}

/// The fewest bits among the rows of a design; else the bits that it has.
hls::IntBits coarsest(std::span<const sim::SweepRow> rows, const DesignChoice& unit) {
  hls::IntBits least = unit.format().bits();
  for (const sim::SweepRow& row : rows) {
    if (row.design != unit.name) continue;
    const hls::IntBits bits = rtl::parse_bits(row.bits);
    if (std::pair(bits.coord, bits.interval) < std::pair(least.coord, least.interval)) least = bits;
  }
  return least;
}

std::vector<std::pair<std::string, std::string>> asked(const ReportCommand& command, const ref::Scene& scene,
                                                       const ref::Bvh& bvh,
                                                       std::span<const sim::SweepRow> rows) {
  const auto sum = [&](const char* column) { return readable_number(cell(rows.front(), column)); };
  return {{"Scene", scene.name},
          {"Triangles", readable_number(std::to_string(scene.mesh.triangles.size()))},
          {"Nodes of the hierarchy", readable_number(std::to_string(bvh.nodes.size()))},
          {"Image", fmt::format("{} x {} pixels", command.scene.width, command.scene.height)},
          {"Rays",
           fmt::format("{} primary, {} secondary, {} shadow; {} outside the cube, which no unit takes",
                       sum("rays_primary"), sum("rays_secondary"), sum("rays_shadow"), sum("rays_rejected"))},
          {"Files beside this page",
           "rows.csv, pictures.csv, pipelines.csv, stability.csv, the diagrams as SVG and "
           "the pictures as PNG; the page itself needs none of them"}};
}

int report(const ReportCommand& command, const CLI::App& options) {
  if (command.image.design().is_float())
    throw std::runtime_error(
        fmt::format("design {}: computes in floats; give an integer design", command.image.name));
  const hls::IntBits image_bits = command.image.format().bits();
  std::vector<hls::IntBits> swept;
  for (const std::string& bits : command.bits) swept.push_back(rtl::parse_bits(bits));
  std::vector<sim::SweepPoint> points;
  if (command.rows.empty()) points = report_points(swept);
  std::optional<Progress> progress("reading the scene");
  const ref::Scene scene = command.scene.load();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::string program = options.get_parent()->version();
  const sim::SweepOptions sweep{.width = command.scene.width,
                                .height = command.scene.height,
                                .threads = command.scene.threads,
                                .progress = [&](double share) { progress->show(share); }};
  progress.emplace("sweeping");
  const sim::RowsFile rows =
      command.rows.empty()
          ? sweep_into(fs::path(command.out) / "rows.csv", program, scene, bvh, points, sweep)
          : take_rows(command.rows, sim::about_sweep(program, scene, bvh, sweep));

  ReportFacts facts;
  facts.version = program;
  facts.command = "hitpipe report " + options_given(options, false);

  facts.scene = scene.name;
  facts.asked = asked(command, scene, bvh, rows.rows);
  facts.rows = rows.rows;
  facts.row_commands = sweep_commands(facts.rows, options_given(options, true));
  facts.seed = command.seed;
  progress.emplace("drawing");
  facts.diagrams = draw_diagrams(facts.rows);
  facts.schematics = draw_schematics();
  for (const area::Entry& entry : area::table_7_2())
    facts.prices.push_back(area::price(rtl::find_design(entry.design), entry.format, rtl::Library::thesis(),
                                       area::Account::built));
  progress.emplace("judging");
  facts.stability =
      measure_stability({.tests = command.tests, .seed = command.seed, .threads = command.scene.threads});
  progress.emplace("rendering");
  facts.pictures = make_pictures(scene, bvh,
                                 {.design = &command.image.design(),
                                  .bits = image_bits,
                                  .coarse = coarsest(facts.rows, command.image),
                                  .scene_options = options_given(options, true),
                                  .width = command.scene.width,
                                  .height = command.scene.height,
                                  .threads = command.scene.threads,
                                  .light = {},
                                  .progress = [&](double share) { progress->show(share); }});
  progress.reset();

  std::vector<host::File> files{{"rows.csv", sim::to_text(rows)},
                                {"pictures.csv", table_text(facts.pictures.rows, Format::csv)},
                                {"pipelines.csv", table_text(pipeline_rows(facts), Format::csv)},
                                {"stability.csv", table_text(stability_rows(facts), Format::csv)}};
  for (const Drawing& d : facts.diagrams) files.push_back({d.file, d.svg});
  files.insert(files.end(), facts.pictures.files.begin(), facts.pictures.files.end());
  files.push_back({"index.html", report_html(facts)});
  host::write_files(command.out, files);

  Wrong wrong = wrong_in(facts.rows);
  wrong.rtl_mismatches += facts.pictures.rtl_mismatches;
  wrong.different_triangles += facts.pictures.different_triangles;
  wrong.different_pixels += facts.pictures.different_pixels;
  for (const Stability& s : facts.stability) wrong.false_misses += s.bits == "fp32" ? 0 : s.false_misses;
  const std::string page = (fs::path(command.out) / "index.html").string();
  fmt::print("{}", record_text({{"page", page},
                                {"rows", facts.rows.size()},
                                {"false_misses", wrong.false_misses},
                                {"rtl_mismatches", wrong.rtl_mismatches},
                                {"different_triangles", wrong.different_triangles},
                                {"different_pixels", wrong.different_pixels}},
                               command.format));
  if (!wrong.any()) return 0;
  fmt::print(stderr, "hitpipe: what must be 0 is not; see {}\n", page);
  return 1;
}

}  // namespace

void add_report_command(CLI::App& program, int& exit_code) {
  CLI::App* const command = program.add_subcommand(
      "report", "Measure every unit on a scene and show error against cost on one page of HTML");
  const auto options = std::make_shared<ReportCommand>();
  add_scene_options(*command, options->scene);
  CLI::Option* const rows =
      command
          ->add_option("--rows", options->rows,
                       "CSV of hitpipe sweep, of this scene and size, instead of a new sweep")
          ->type_name("FILE");
  command
      ->add_option("--bits", options->bits,
                   "Number formats of the integer designs to measure (default: as hitpipe sweep)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->excludes(rows)
      ->type_name("n/t,...");
  command
      ->add_option("--image-design", options->image.name,
                   "The integer design whose Verilog renders the image")
      ->capture_default_str()
      ->type_name("NAME");
  command->add_option("--image-bits", options->image.bits, "Its number format; 20/24 unless given")
      ->type_name("n/t");
  command->add_option("--tests", options->tests, "Of each unit's stability (1 to 10^9)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}).description(""))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of these tests; the same seed gives the same")
      ->type_name("N")
      ->capture_default_str();
  add_folder_option(*command, options->out, "Folder for index.html, its rows and its pictures")->required();
  add_format_option(*command, options->format);
  command->callback([options, command, &exit_code] { exit_code = report(*options, *command); });
}

}  // namespace hitpipe::cli
