#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "area_model/price.hpp"
#include "cli/commands.hpp"
#include "cli/options/cost_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/picture_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/report/python.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "cli/version.hpp"
#include "host/machine.hpp"
#include "host/outputs.hpp"
#include "host/talk.hpp"
#include "sim/cosim/generic_tracer.hpp"
#include "sim/fit/fit_scene.hpp"
#include "sim/software/software.hpp"
#include "sim/sweep/resume.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

/// What --without takes, as the programs of cli/report call them.
constexpr std::array<std::string_view, 8> sections{"pipelines", "world", "core",   "stability",
                                                   "stiff",     "fit",   "images", "schematics"};

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
  std::optional<double> plot_width_mm;
  std::vector<std::string> without;  ///< sections
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
    const bool of_scene =
        name != "--out" && name != "--plot-width" && name != "--rows" && name != "--bits" && name != "--ii" &&
        !name.starts_with("--image-") && name != "--tests" && name != "--seed" && name != "--threads" &&
        name != "--format" && name != "--faces" && name != "--without" &&
        std::ranges::find(talk_options(), name) == talk_options().end() && !option->get_positional();
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

/// What the programs in Python know of a design.
Row facts_of(const rtl::Design& design) {
  return {{"place", rtl::place_of(design).value()},
          {"conservative", design.conservative},
          {"single", design.default_format.family().single}};
}

Row unit_row(const rtl::Design& design, const Format& format) {
  return {{"design", design.name},
          {"bits", to_string(format)},
          {"bits_option", design.bits_option(format)},
          {"name", design.name_at(format)}};
}

/// The units that a report looks at closely: each design that the user named in its usual format, or else in
/// the last one that is swept. If none is named, the thesis's six units (Table 7.2).
std::vector<std::pair<const rtl::Design*, Format>> close_units(const std::vector<sim::DesignFormats>& formats,
                                                               bool named) {
  std::vector<std::pair<const rtl::Design*, Format>> units;
  if (!named)
    for (const area::Entry& entry : area::table_7_2())
      units.emplace_back(&rtl::find_design(entry.design), entry.format);
  for (const sim::DesignFormats& each : named ? formats : std::vector<sim::DesignFormats>{}) {
    const bool usual = std::ranges::find(each.formats, each.design->default_format) != each.formats.end();
    units.emplace_back(each.design, usual ? each.design->default_format : each.formats.back());
  }
  return units;
}

/// The design whose Verilog renders, and the formats of its maps of extra tests with the options of their
/// traversals: its own, and the smallest that is swept.
Row image_row(const DesignChoice& image, const std::vector<sim::DesignFormats>& swept) {
  const rtl::Design& design = image.design();
  std::vector<Format> formats{image.format()};
  for (const sim::DesignFormats& each : swept) {
    if (each.design != &design) continue;
    const Format least = *std::ranges::min_element(each.formats, {}, &Format::numbers);
    if (least != formats.front()) formats.push_back(least);
  }
  Row row = unit_row(design, formats.front());
  row["tracers"] = Row::array();
  if (const auto named = sim::software_of(design).named_tracer)
    for (const Format& format : formats)
      row["tracers"].push_back({to_string(format), trace_options_text(named(format))});
  return row;
}

/// The rows that the user has, at the cost of a triangle test that the user says now, as rows.csv.
std::vector<sim::SweepRow> take_rows(const ReportCommand& command, const ref::Scene& scene,
                                     const rtl::Library& library) {
  const ref::Bvh bvh = ref::make_hierarchy(scene, command.hierarchy).bvh;
  const sim::TriangleCost triangle = command.cost.triangle(library);
  std::vector<sim::SweepRow> rows =
      sim::read_rows_of(command.rows, sim::sweep_subject(scene, bvh,
                                                         {.width = command.scene.width,
                                                          .height = command.scene.height,
                                                          .threads = command.scene.threads,
                                                          .light = command.light,
                                                          .program = std::string(program_version()),
                                                          .hierarchy = command.hierarchy.name(),
                                                          .library = &library,
                                                          .tests_only = command.cost.tests_only,
                                                          .triangle = triangle}));
  if (rows.empty()) throw std::runtime_error(fmt::format("{}: holds no rows", command.rows));
  if (command.cost.says_triangle())
    for (sim::SweepRow& row : rows) row.triangle = triangle;
  return rows;
}

/// The formats of each design that the rows have.
std::vector<sim::DesignFormats> formats_of(const std::vector<sim::SweepRow>& rows) {
  std::vector<sim::DesignFormats> formats;
  for (const sim::SweepRow& row : rows) {
    const rtl::Design& design = rtl::find_design(row.design);
    auto of = std::ranges::find(formats, &design, &sim::DesignFormats::design);
    if (of == formats.end()) of = formats.insert(formats.end(), {&design, {}});
    const Format format = design.parse_format(row.bits);
    if (std::ranges::find(of->formats, format) == of->formats.end()) of->formats.push_back(format);
  }
  return formats;
}

/// All that report/report.py needs to know, after all that can be refused has been.
Row plan_of(const ReportCommand& command, const CLI::App& options) {
  if (!command.image.design().conservative)
    throw std::runtime_error(
        fmt::format("design {}: can miss boxes; give a design that never does", command.image.name));
  if (const std::string why = sim::why_not_traced(command.image.design()); !why.empty())
    throw std::runtime_error(why);
  // What --rows may name.
  for (const char* const name :
       {"rows.csv", "pictures.csv", "pipelines.csv", "stability.csv", "stiffness.csv", "integer_world.csv",
        "core.csv", "fitted.csv", "left_out.csv", "core_fit.csv"})
    host::announce_output("--out", fs::path(command.out) / name);
  const rtl::Library library = command.cost.load();
  const bool named = !command.swept.names.empty();
  std::vector<sim::DesignFormats> formats;
  if (command.rows.empty())
    formats = command.swept.formats(priced_by(library, command.swept.designs(sim::why_not_traced), named),
                                    sim::sweep_formats);
  std::optional<Progress> progress("reading the scene");
  const ref::Scene scene = command.scene.load();
  std::vector<sim::SweepRow> rows;
  if (!command.rows.empty()) {
    rows = take_rows(command, scene, library);
    formats = formats_of(rows);
  }
  progress.reset();
  Row plan{{"program", fs::read_symlink("/proc/self/exe").string()},
           {"version", program_and_sources()},
           {"command", command_line(options)},
           {"out", command.out},
           {"threads", Row::array()},
           {"talk", host::talk() == host::Talk::quiet     ? Row{"--quiet"}
                    : host::talk() == host::Talk::verbose ? Row{"--verbose"}
                                                          : Row::array()},
           {"plot_width_mm", command.plot_width_mm ? Row(*command.plot_width_mm) : Row(nullptr)},
           {"format", command.format == OutputFormat::json  ? "json"
                      : command.format == OutputFormat::csv ? "csv"
                                                            : "text"},
           {"scene", scene.name},
           {"scene_file", fs::path(scene.name).stem().string()},
           {"mesh", summary_of(scene_row(scene))},
           {"hierarchy", command.hierarchy.text()},
           {"machine", host::processor()},
           {"notes", camera_notes(scene)},
           {"width", command.scene.width},
           {"height", command.scene.height},
           {"sweep_options", options_given(options, Given::of_sweep, command.hierarchy)},
           {"scene_options", options_given(options, Given::of_scene, command.hierarchy)},
           {"view_options", options_given(options, Given::of_view, command.hierarchy)},
           {"library_option", command.cost.library == rtl::default_library
                                  ? ""
                                  : "--library " + host::shell_word(command.cost.library)},
           {"named", named},
           {"rows_given", !command.rows.empty()},
           {"bits", command.swept.bits},
           {"intervals", command.intervals.empty() ? std::vector{1} : command.intervals},
           {"tests", command.tests},
           {"ratio_tests", command.ratio_tests},
           {"seed", command.seed},
           {"baseline", area::baseline_design().design},
           {"image", image_row(command.image, formats)},
           {"fit_designs", Row::array()},
           {"without", command.without}};
  if (options.get_option("--threads")->count() > 0)
    plan["threads"] = {"--threads", fmt::format("{}", command.scene.threads)};
  for (const sim::DesignFormats& each : formats) {
    plan["designs"].push_back(each.design->name);
    if (sim::why_not_fitted(*each.design).empty()) plan["fit_designs"].push_back(each.design->name);
  }
  for (const rtl::Design* const design : traced_designs())
    plan["catalogue"][std::string(design->name)] = facts_of(*design);
  for (const area::Entry& entry : area::table_7_2())
    plan["thesis"].push_back(rtl::find_design(entry.design).name_at(entry.format));
  plan["priced_units"] = Row::array();
  for (const auto& [design, format] : close_units(formats, named)) {
    const Row unit = unit_row(*design, format);
    if (sim::why_not_priced(*design, format, library).empty()) plan["priced_units"].push_back(unit);
  }
  if (!rows.empty()) {
    host::make_folder(command.out);
    host::write_file(fs::path(command.out) / "rows.csv", sim::to_csv(rows));
  }
  return plan;
}

/// Becomes the program that makes the report, so that signals and the exit code are its own.
void report(const ReportCommand& command, const CLI::App& options) {
  std::vector<std::string> words = python_program("report", "report.py");
  const std::string plan = plan_of(command, options).dump();
  host::note_step(fmt::format("runs {}", fmt::join(words, " ")));
  words.push_back(plan);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  execvp(arguments.front(), arguments.data());
  throw std::runtime_error(fmt::format("report: {}: {}", words.front(), std::strerror(errno)));
}

}  // namespace

CLI::App* add_report_command(CLI::App& program, int& /*exit_code*/) {
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
  add_plot_width_option(*command, options->plot_width_mm);
  add_list_option(*command, "--without", options->without,
                  fmt::format("Leave out these sections: {}", fmt::join(sections, ", ")), "SECTION")
      ->check(CLI::Validator(
          [](const std::string& name) {
            return std::ranges::find(sections, name) != sections.end()
                       ? std::string()
                       : fmt::format("no section {}; there are: {}", host::shortened(name),
                                     fmt::join(sections, ", "));
          },
          ""));
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe report --scene spheres --out report",
                          "hitpipe report int_slabs,int_major --scene terrain --without core --out report"});
  command->callback([options, command, tests] {
    if (tests->count() > 0) options->ratio_tests = options->tests;
    options->hierarchy.build.threads = options->scene.threads;
    report(*options, *command);
  });
  return command;
}

}  // namespace hitpipe::cli
