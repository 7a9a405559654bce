#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/world_sweep.hpp"
#include "cli/options/cost_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/report/core_plot.hpp"
#include "cli/report/report_sections.hpp"
#include "cli/report/report_sweep.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/last_line.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "cli/version.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "sim/software.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

constexpr int world_mantissa = 11;  ///< p of the boxes in the integer world

struct ReportCommand {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  ref::WhittedOptions light;
  DesignChoice image;
  DesignsChoice swept;
  std::vector<int> intervals;  ///< empty: a test in every cycle
  CostChoice cost;
  std::string rows;
  std::uint64_t tests = 1'000'000;     ///< of each unit
  std::uint64_t ratio_tests = 20'000;  ///< for each ratio of stiff rays; --tests sets both
  std::uint64_t seed = 1;
  std::string out;
  PictureForm plots = report_form;
  OutputFormat format = OutputFormat::text;
};

/// Which of the options that the user gave.
enum class Given { of_view, of_scene, of_sweep };

/// The options as the user gave them. Options of the scene go to pictures and to a sweep, options of costs
/// to a sweep alone. A view is a scene without the picture's size and light. Commands have other usual
/// hierarchies, so for them the hierarchy is always said.
std::string options_given(const CLI::App& command, Given which, const ref::HierarchyOptions& hierarchy) {
  std::string text;
  for (const CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    const bool of_scene = name != "--out" && name != "--plot-width" && name != "--rows" && name != "--bits" &&
                          name != "--ii" && !name.starts_with("--image-") && name != "--tests" &&
                          name != "--seed" && name != "--threads" && name != "--format" &&
                          name != "--faces" && !option->get_positional();
    const bool of_cost = name == "--library" || name == "--tests-only" || name.starts_with("--triangle-");
    const bool of_picture = name == "--width" || name == "--height" || name == "--bounces" ||
                            name == "--diffuse" || name == "--occlusion" || name == "--light-seed";
    const bool of_hierarchy =
        std::ranges::find(hierarchy_option_names(), name) != hierarchy_option_names().end();
    if (option->count() == 0 || of_hierarchy || !of_scene || (which != Given::of_sweep && of_cost) ||
        (which == Given::of_view && of_picture))
      continue;
    const bool flag = option->get_items_expected_max() == 0;
    if (flag) text += fmt::format("{}{}", text.empty() ? "" : " ", name);
    for (const std::string& result : flag ? std::vector<std::string>{} : option->results())
      text += fmt::format("{}{} {}", text.empty() ? "" : " ", name, host::shell_word(result));
  }
  ref::HierarchyOptions said = hierarchy;
  if (which == Given::of_view) said.build.padding = ref::BuildOptions{}.padding;  // a core's boxes have none
  return text + " " + hierarchy_arguments(said);
}

/// The smallest format of a design among the rows. If there is none, the format that the design has.
rtl::Format coarsest(std::span<const sim::SweepRow> rows, const DesignChoice& unit) {
  rtl::Format least = unit.format();
  for (const sim::SweepRow& row : rows) {
    if (row.design != unit.name) continue;
    const rtl::Format format = unit.design().parse_format(row.bits);
    if (format.numbers() < least.numbers()) least = format;
  }
  return least;
}

std::vector<const rtl::Design*> traced_designs() {
  std::vector<const rtl::Design*> traced;
  for (const rtl::Design& design : rtl::designs())
    if (sim::why_not_traced(design).empty()) traced.push_back(&design);
  return traced;
}

/// The first conservative design that can be swept.
std::string image_design() {
  for (const rtl::Design* const design : traced_designs())
    if (design->conservative) return std::string(design->name);
  return "";
}

/// "int_slabs,int_major ".
std::string conservative_names(const std::vector<MeasuredDesign>& designs) {
  std::string names;
  for (const MeasuredDesign& each : designs)
    names += fmt::format("{}{}", names.empty() ? "" : ",", each.design->name);
  return names + " ";
}

std::vector<std::pair<std::string, std::string>> asked(const ReportCommand& command, const ref::Scene& scene,
                                                       const ref::Bvh& bvh,
                                                       std::span<const sim::SweepRow> rows) {
  const auto sum = [&](const char* column) { return readable_number(cell(rows.front(), column)); };
  return {{"Scene", scene.name},
          {"Mesh", summary_of(scene_row(scene))},
          {"Hierarchy", command.hierarchy.text()},
          {"Nodes of the hierarchy", readable_number(std::to_string(bvh.nodes.size()))},
          {"Image", fmt::format("{} x {} pixels", command.scene.width, command.scene.height)},
          {"Rays",
           fmt::format("{} primary, {} secondary, {} shadow; {} outside the cube, which no unit takes",
                       sum("rays_primary"), sum("rays_secondary"), sum("rays_shadow"), sum("rays_rejected"))},
          {"Files beside this page",
           "rows.csv, pictures.csv, pipelines.csv, stability.csv, stiffness.csv, integer_world.csv, "
           "core.csv, what they share in csv-metadata.json, the diagrams as SVG, PDF and programs of "
           "gnuplot, and the pictures as PNG; the page itself needs none of them"}};
}

int report(const ReportCommand& command, const CLI::App& options) {
  if (!command.image.design().conservative)
    throw std::runtime_error(
        fmt::format("design {}: can miss boxes; give a design that never does", command.image.name));
  if (const std::string why = sim::why_not_traced(command.image.design()); !why.empty())
    throw std::runtime_error(why);
  // What --rows may name.
  for (const char* const name : {"rows.csv", "pictures.csv", "pipelines.csv", "stability.csv",
                                 "stiffness.csv", "integer_world.csv", "core.csv"})
    host::announce_output("--out", fs::path(command.out) / name);
  const rtl::Format image_format = command.image.format();
  const rtl::Library library = command.cost.load();
  const sim::TriangleCost triangle = command.cost.triangle(library);
  const bool named = !command.swept.names.empty();
  const std::vector<const rtl::Design*> designs =
      command.rows.empty() ? priced_by(library, command.swept.designs(sim::why_not_traced), named)
                           : traced_designs();
  const std::vector<sim::DesignFormats> formats = command.swept.formats(designs, sim::sweep_formats);
  const std::vector<ReportUnit> units = report_units(formats, named);
  std::vector<sim::SweepPoint> points;
  if (command.rows.empty())
    points = report_points(formats, units, command.intervals.empty() ? std::vector{1} : command.intervals,
                           library);
  std::optional<Progress> progress("reading the scene");
  const ref::Scene scene = command.scene.load();
  const ref::Bvh bvh = ref::make_hierarchy(scene, command.hierarchy).bvh;
  const sim::SweepOptions sweep{.width = command.scene.width,
                                .height = command.scene.height,
                                .threads = command.scene.threads,
                                .light = command.light,
                                .program = std::string(program_version()),
                                .hierarchy = command.hierarchy.name(),
                                .library = &library,
                                .tests_only = command.cost.tests_only,
                                .triangle = triangle,
                                .progress = [&](double share) { progress->show(share); }};
  progress.emplace("sweeping");
  const fs::path rows_file = fs::path(command.out) / "rows.csv";
  std::optional<LastLine> line;
  if (command.rows.empty())
    line.emplace(fmt::format("the same command goes on with the rows of {}", rows_file.string()));
  std::vector<sim::SweepRow> rows = command.rows.empty()
                                        ? sim::resume({.scene = &scene,
                                                       .bvh = &bvh,
                                                       .points = points,
                                                       .options = sweep,
                                                       .file = rows_file,
                                                       .more = {}})
                                        : take_rows(command.rows, sim::sweep_subject(scene, bvh, sweep));
  // The rows of a sweep have the cost that it was told, unless the user says another one now.
  if (command.cost.says_triangle())
    for (sim::SweepRow& row : rows) row.triangle = triangle;

  ReportFacts facts;
  facts.version = program_and_sources();
  facts.command = command_line(options);

  facts.scene = scene.name;
  facts.named = named;
  facts.asked = asked(command, scene, bvh, rows);
  facts.rows = rows;
  facts.row_commands = sweep_commands(facts.rows, options_given(options, Given::of_sweep, command.hierarchy));
  facts.seed = command.seed;
  progress.emplace("drawing");
  facts.diagrams = draw_diagrams(facts.rows, command.plots);
  facts.schematics = draw_schematics(designs);
  const std::string library_option =
      command.cost.library == rtl::default_library
          ? ""
          : fmt::format(" --library {}", host::shell_word(command.cost.library));
  facts.prices = report_prices(units, facts.rows, library);
  facts.area_commands = price_commands(facts.prices, library_option);
  progress.emplace("judging");
  facts.stability = measure_stability(
      units, {.tests = command.tests, .seed = command.seed, .threads = command.scene.threads});
  facts.stiffness = measure_stiffness(
      designs, {.tests = command.ratio_tests, .seed = command.seed, .threads = command.scene.threads});
  facts.stiffness_command =
      fmt::format("hitpipe check --stiff {}--tests {} --seed {} --out FOLDER",
                  named ? conservative_names(facts.stiffness) : "", command.ratio_tests, command.seed);
  if (!facts.stiffness.empty())
    facts.stiffness_diagram.emplace(Diagrammed{
        draw_picture("report", stiffness_picture(boxes_plot(facts.stiffness), command.plots), command.plots),
        fmt::format("{} boxes for each ratio.", readable_number(std::to_string(command.ratio_tests)))});
  progress.emplace("sweeping the integer world");
  facts.world = world_rows({.design = &rtl::find_design("int_triangle"),
                            .formats = usual_world_formats(),
                            .mantissas = {world_mantissa},
                            .scene = command.scene,
                            .hierarchy = command.hierarchy,
                            .light = command.light,
                            .library = &library,
                            .interval = 1},
                           scene, [&](double share) { progress->show(share); });
  facts.world_command =
      fmt::format("hitpipe sweep int_triangle {}{} --mantissas {} --out integer_world.csv",
                  options_given(options, Given::of_scene, command.hierarchy), library_option, world_mantissa);
  facts.world_diagram = draw_world(facts.world, command.plots);
  progress.emplace("tracing with cores");
  facts.core =
      measure_core(scene, {.library = &library,
                           .library_option = library_option,
                           .scene_options = options_given(options, Given::of_view, command.hierarchy),
                           .hierarchy = command.hierarchy,
                           .width = command.scene.width,
                           .height = command.scene.height,
                           .threads = command.scene.threads,
                           .progress = [&](double share) { progress->show(share); }});
  facts.core_diagrams = draw_core(scene.name, facts.core, command.plots);
  progress.emplace("rendering");
  facts.pictures = make_pictures(scene, bvh,
                                 {.design = &command.image.design(),
                                  .format = image_format,
                                  .coarse = coarsest(facts.rows, command.image),
                                  .library = &library,
                                  .library_option = library_option,
                                  .scene_options = options_given(options, Given::of_scene, command.hierarchy),
                                  .width = command.scene.width,
                                  .height = command.scene.height,
                                  .threads = command.scene.threads,
                                  .light = command.light,
                                  .progress = [&](double share) { progress->show(share); }});
  progress.reset();

  std::vector<host::File> files{{"rows.csv", sim::to_csv(rows)},
                                {"pictures.csv", table_text(facts.pictures.rows, OutputFormat::csv)},
                                {"pipelines.csv", table_text(pipeline_rows(facts), OutputFormat::csv)},
                                {"stability.csv", table_text(stability_rows(facts), OutputFormat::csv)},
                                {"integer_world.csv", table_text(facts.world, OutputFormat::csv)}};
  if (!facts.stiffness.empty())
    files.push_back({"stiffness.csv", table_text(stiffness_rows(facts.stiffness, ""), OutputFormat::csv)});
  if (!facts.core.rows.empty()) files.push_back({"core.csv", table_text(facts.core.rows, OutputFormat::csv)});
  std::vector<CsvTable> tables;
  for (const host::File& file : files)
    if (file.name.ends_with(".csv")) tables.push_back(csv_table(file.name, file.contents));
  Row notes = notes_of(options);
  notes.update(camera_notes(scene));
  files.push_back({"csv-metadata.json", csv_metadata(tables, notes)});
  const auto add = [&](const Diagrammed& d) {
    const std::vector<host::File> drawn = picture_files(d.picture);
    files.insert(files.end(), drawn.begin(), drawn.end());
  };
  for (const auto& diagrams : {facts.diagrams, facts.core_diagrams})
    std::for_each(diagrams.begin(), diagrams.end(), add);
  if (facts.stiffness_diagram) add(*facts.stiffness_diagram);
  add(facts.world_diagram);
  files.insert(files.end(), facts.pictures.files.begin(), facts.pictures.files.end());
  files.push_back({"index.html", report_html(facts)});
  host::write_files(command.out, files);

  Wrong wrong = wrong_in(facts.rows);
  wrong.rtl_mismatches += facts.pictures.rtl_mismatches;
  wrong.different_triangles += facts.pictures.different_triangles;
  wrong.different_pixels += facts.pictures.different_pixels;
  for (const Stability& s : facts.stability)
    wrong.false_misses += rtl::find_design(s.design).conservative ? s.all.false_misses : 0;
  wrong.false_misses += wrong_answers(facts.stiffness);
  wrong.core_answers = facts.core.wrong() + facts.core.other_reads();
  const std::string page = (fs::path(command.out) / "index.html").string();
  fmt::print("{}", record_text({{"page", page},
                                {"rows", facts.rows.size()},
                                {"false_misses", wrong.false_misses},
                                {"rtl_mismatches", wrong.rtl_mismatches},
                                {"different_triangles", wrong.different_triangles},
                                {"different_pixels", wrong.different_pixels},
                                {"wrong_core_answers", wrong.core_answers}},
                               command.format));
  if (facts.schematics.empty())
    fmt::print(
        stderr,
        "hitpipe: the page has no schematics, because Graphviz's dot was not found; install the package "
        "graphviz\n");
  if (!wrong.any()) return 0;
  fmt::print(stderr, "hitpipe: a count that must be 0 is not; see {}\n", page);
  return 1;
}

}  // namespace

CLI::App* add_report_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("report", "Measure all designs on a scene: error against cost, as HTML");
  const auto options = std::make_shared<ReportCommand>();
  add_scene_options(*command, options->scene);
  add_hierarchy_options(*command, options->hierarchy);
  add_light_options(*command, options->light);
  const CLI::Option* const rows =
      as_input(command->add_option(
                   "--rows", options->rows,
                   "Read the rows from a CSV file that hitpipe sweep wrote for this scene and size"))
          ->type_name("FILE");
  exclude(add_designs_option(*command, options->swept, "all"), rows,
          "the rows of the file have their designs");
  exclude(add_bits_option(*command, options->swept, "as hitpipe sweep"), rows,
          "the rows of the file have their formats");
  exclude(add_intervals_option(*command, options->intervals,
                               "a test may begin every N cycles; the report has a row for each number and "
                               "shows area against rate"),
          rows, "the rows of the file have their intervals");
  add_cost_options(*command, options->cost);
  options->image.name = image_design();
  command
      ->add_option("--image-design", options->image.name,
                   "The design whose Verilog renders the image; it must be one that never misses")
      ->capture_default_str()
      ->type_name("NAME");
  command->add_option("--image-bits", options->image.bits, "Its number format")->type_name("FORMAT");
  const CLI::Option* const tests =
      add_large_count_option(*command, "--tests", options->tests, 1, 1'000'000'000,
                             "Number of stability tests for each unit, and for each ratio of stiff rays, "
                             "which without it has 20000 (1 to 10^9)");
  add_seed_option(*command, options->seed);
  add_folder_option(*command, options->out, "Folder for index.html, its rows and its pictures")->required();
  add_plot_width_option(*command, options->plots);
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe report --scene spheres --out report",
                          "hitpipe report int_slabs,int_major --scene terrain --out report"});
  command->callback([options, command, tests, &exit_code] {
    if (tests->count() > 0) options->ratio_tests = options->tests;
    options->hierarchy.build.threads = options->scene.threads;
    exit_code = report(*options, *command);
  });
  return command;
}

}  // namespace hitpipe::cli
