#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/table.hpp"
#include "cli/trace_options.hpp"
#include "cli/values.hpp"
#include "sim/cosim.hpp"
#include "sim/fit/fit.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

struct FitCommand {
  SceneChoice scene;
  ref::WhittedOptions light;
  bool no_shadows = false;
  std::vector<std::string> designs;
  double overhead_pct = 2.0;
  std::string bits = "24/24";
  bool keep_bits = false;
  std::string out;
  Format format = Format::text;
};

struct FitScene {
  ref::Scene scene;
  ref::Bvh bvh;
  ref::SceneDemands demands;
};

FitScene load(const FitCommand& command) {
  ref::Scene scene = command.scene.load();
  if (command.no_shadows) scene.lights.clear();
  ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const ref::ViewOptions view{command.scene.width, command.scene.height, command.light.bounces};
  ref::SceneDemands demands = ref::scene_demands(scene, bvh, view);
  return {std::move(scene), std::move(bvh), std::move(demands)};
}

std::vector<const rtl::Design*> chosen_designs(const FitCommand& command) {
  std::vector<const rtl::Design*> designs;
  if (command.designs.empty())
    for (const rtl::Design& design : rtl::designs()) designs.push_back(&design);
  for (const std::string& name : command.designs) designs.push_back(&rtl::find_design(name));
  return designs;
}

double percent_of(std::int64_t part, std::int64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

double mm2(std::int64_t area_um2) {
  return static_cast<double>(area_um2) * 1e-6;
}

/// mm2 times ns.
double area_delay(const area::Price& price) {
  return static_cast<double>(price.area_delay()) * 1e-9;
}

std::string left_out_text(const sim::LeftOut& left, const sim::FittedUnit& unit) {
  return fmt::format("{} ({}): {:.2f} % of the area", left.what, left.why,
                     percent_of(left.area_um2, unit.price_before.area_um2));
}

Row record(const sim::FittedUnit& unit, const FitScene& scene, const sim::CosimResult& result) {
  Row left_out = Row::array();
  for (const sim::LeftOut& left : unit.left_out) left_out.push_back(left_out_text(left, unit));
  Row demands = Row::array();
  for (std::size_t i = 0; i < unit.demands.count(); ++i) demands.push_back(rtl::demand_text(unit.demands, i));
  return {{"design", unit.design->name},
          {"bits", rtl::to_string(unit.format)},
          {"bits_before", rtl::to_string(unit.before)},
          {"scene", scene.scene.name},
          {"area_before_mm2", mm2(unit.price_before.area_um2)},
          {"area_after_mm2", mm2(unit.price.area_um2)},
          {"area_saved_pct", percent_of(unit.saved_um2(), unit.price_before.area_um2)},
          {"stages_before", unit.price_before.stages},
          {"stages", unit.price.stages},
          {"area_delay_before_mm2_ns", area_delay(unit.price_before)},
          {"area_delay_mm2_ns", area_delay(unit.price)},
          {"bytes_per_node_before", sim::bytes_per_node(unit.before)},
          {"bytes_per_node", sim::bytes_per_node(unit.format)},
          {"rays", result.rays_primary + result.rays_secondary + result.rays_shadow},
          {"box_tests", result.unit.box_tests},
          {"extra_box_tests_pct", result.extra_box_tests_pct()},
          {"different_triangles", result.different_triangles},
          {"false_misses", unit.design->is_float() ? Row(nullptr) : Row(result.unit.false_misses)},
          {"rtl_mismatches", result.unit.rtl_mismatches},
          {"demands", demands},
          {"left_out", left_out}};
}

/// As eighty columns hold it.
Row short_row(const Row& row) {
  return {{"design", row.at("design")},
          {"bits", row.at("bits")},
          {"mm2", fmt::format("{:.4f}", row.at("area_before_mm2").get<double>())},
          {"fitted", fmt::format("{:.4f}", row.at("area_after_mm2").get<double>())},
          {"saved%", fmt::format("{:.1f}", row.at("area_saved_pct").get<double>())},
          {"stages", fmt::format("{}>{}", row.at("stages_before").get<int>(), row.at("stages").get<int>())},
          {"ADP%", fmt::format("{:.1f}", 100.0 - 100.0 * row.at("area_delay_mm2_ns").get<double>() /
                                                     row.at("area_delay_before_mm2_ns").get<double>())},
          {"bytes", row.at("bytes_per_node")},
          {"extra%", fmt::format("{:+.2f}", row.at("extra_box_tests_pct").get<double>())},
          {"wrong", row.at("different_triangles").get<std::uint64_t>() +
                        row.at("rtl_mismatches").get<std::uint64_t>()}};
}

std::string rows_text(const std::vector<Row>& rows, const FitScene& scene, Format format) {
  if (format != Format::text) return table_text(rows, format);
  std::string text = fmt::format("What {} asks for\n", scene.scene.name);
  for (const ref::Evidence& each : scene.demands.evidence())
    text += fmt::format("  {}\n    {}\n", each.demand, each.why);
  std::vector<Row> table;
  for (const Row& row : rows) table.push_back(short_row(row));
  text += "\n" + table_text(table, format);
  for (const Row& row : rows) {
    text += fmt::format("\n{} {}: left out\n", row.at("design").get<std::string>(),
                        row.at("bits").get<std::string>());
    for (const Row& left : row.at("left_out")) text += fmt::format("  {}\n", left.get<std::string>());
    if (row.at("left_out").empty()) text += "  nothing: the scene needs it all\n";
  }
  return text;
}

std::optional<sim::Precision> precision_of(const FitCommand& command, const rtl::Design& design,
                                           const FitScene& scene, const sim::SceneRays& rays) {
  if (command.keep_bits || design.is_float()) return std::nullopt;
  return sim::fewest_bits({.design = &design,
                           .scene = &scene.scene,
                           .bvh = &scene.bvh,
                           .rays = &rays,
                           .most = design.parse_format(command.bits).bits(),
                           .overhead_pct = command.overhead_pct,
                           .threads = command.scene.threads});
}

struct Proved {
  Row row;
  bool good;
};

Proved fit_design(const FitCommand& command, const rtl::Design& design, const FitScene& scene,
                  const sim::SceneRays& rays) {
  const rtl::Library& library = rtl::Library::thesis();
  const std::string name(design.name);
  std::optional<Progress> progress(name + ": looking for the fewest bits");
  const rtl::Format before = design.is_float() ? rtl::Format::fp32() : design.parse_format(command.bits);
  const sim::FittedUnit unit =
      sim::fit(design, before, precision_of(command, design, scene, rays), scene.demands, library);
  std::vector<rtl::File> files = sim::fitted_files(unit, library);
  progress.emplace(name + ": compiling the Verilog");
  const sim::VerilatedDesign verilated(design, unit.format, unit.pipeline, files.front().contents);
  for (rtl::File& drawing : rtl::draw(files)) files.push_back(std::move(drawing));
  rtl::write_files(fs::path(command.out) / name, files);
  progress.emplace(name + ": co-simulating");
  const sim::OperandGuard guard(unit.demands, unit.ports);
  const sim::CosimResult result = sim::cosimulate(design, unit.format, verilated, scene.scene, scene.bvh,
                                                  {.width = command.scene.width,
                                                   .height = command.scene.height,
                                                   .threads = command.scene.threads,
                                                   .referee = !design.is_float(),
                                                   .light = command.light,
                                                   .scene_demands = &scene.demands,
                                                   .guard = &guard,
                                                   .progress = [&](double share) { progress->show(share); }});
  return {record(unit, scene, result), result.verified(!design.is_float())};
}

int fit(const FitCommand& command) {
  const std::vector<const rtl::Design*> designs = chosen_designs(command);
  for (const rtl::Design* design : designs) {
    // Before the long run: a format that no design has is known at once.
    if (!design->is_float()) (void)design->trace(design->parse_format(command.bits));
  }
  std::optional<Progress> progress("reading the scene");
  const FitScene scene = load(command);
  progress.emplace("tracing the scene's rays");
  sim::SceneRays rays;
  if (!command.keep_bits)
    rays = sim::scene_rays(scene.scene, scene.bvh,
                           {.width = command.scene.width,
                            .height = command.scene.height,
                            .threads = command.scene.threads,
                            .light = command.light,
                            .progress = [&](double share) { progress->show(share); }});
  progress.reset();
  std::vector<Row> rows;
  std::string wrong;
  for (const rtl::Design* design : designs) {
    Proved proved = fit_design(command, *design, scene, rays);
    if (!proved.good) wrong += (wrong.empty() ? "" : ", ") + std::string(design->name);
    rows.push_back(std::move(proved.row));
  }
  fmt::print("{}", rows_text(rows, scene, command.format));
  if (wrong.empty()) return 0;
  fmt::print(
      stderr,
      "hitpipe: fitted to {}: {} did not answer as the reference; different triangles, false misses and "
      "RTL mismatches must all be 0\n",
      scene.scene.name, wrong);
  return 1;
}

}  // namespace

void add_fit_command(CLI::App& program, int& exit_code) {
  CLI::App* const command = program.add_subcommand(
      "fit", "Leave out of the designs what a scene does not need, and prove that nothing is missed");
  const auto options = std::make_shared<FitCommand>();
  add_scene_options(*command, options->scene);
  add_bounces_option(*command, options->light);
  command->add_flag("--no-shadows", options->no_shadows, "Switch the lights off: no shadow rays");
  command->add_option("--designs", options->designs, "Names that `hitpipe designs` lists; all unless given")
      ->delimiter(',')
      ->type_name("NAME,...");
  command
      ->add_option("--overhead", options->overhead_pct,
                   "Most extra box tests of an integer design with fewer bits, in percent")
      ->check(CLI::Range(0.0, 1000.0).description(""))
      ->capture_default_str()
      ->type_name("P");
  command->add_option("--bits", options->bits, "Number format of integer designs before the fit")
      ->capture_default_str()
      ->type_name("n/t");
  command->add_flag("--keep-bits", options->keep_bits, "Leave the number format as it is");
  add_folder_option(*command, options->out, "Folder for each design's Verilog, manifest and testbench")
      ->required();
  add_format_option(*command, options->format);
  command->callback([options, &exit_code] { exit_code = fit(*options); });
}

}  // namespace hitpipe::cli
