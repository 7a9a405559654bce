#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "cli/commands.hpp"
#include "cli/fit_text.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/trace_options.hpp"
#include "cli/values.hpp"
#include "host/files.hpp"
#include "sim/cosim.hpp"
#include "sim/fit/vector_check.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

struct FitCommand {
  SceneChoice scene;
  ref::WhittedOptions light;
  bool no_shadows = false;
  std::vector<std::string> designs;
  double overhead_pct = 2.0;
  std::optional<std::string> bits;
  bool keep_bits = false;
  std::uint64_t vectors = 1'000'000;
  std::string out;
  Format format = Format::text;
};

rtl::Format format_before(const FitCommand& command, const rtl::Design& design) {
  return design.is_float() ? rtl::Format::fp32() : design.parse_format(command.bits.value_or("24/24"));
}

constexpr double most_overhead_pct = 1000.0;

/// CLI::Range takes NaN for a number.
std::string overhead_problem(const std::string& text) {
  const double value = std::strtod(text.c_str(), nullptr);
  if (value >= 0.0 && value <= most_overhead_pct) return "";
  return fmt::format("Value {} not in range 0 to {}", text, most_overhead_pct);
}

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

/// Each once. Throws when a name or the number format is none: before the long run.
std::vector<const rtl::Design*> chosen_designs(const FitCommand& command) {
  std::vector<const rtl::Design*> designs;
  const auto choose = [&](const rtl::Design& design) {
    if (std::find(designs.begin(), designs.end(), &design) == designs.end()) designs.push_back(&design);
  };
  for (const std::string& name : command.designs) choose(rtl::find_design(name));
  if (designs.empty())
    for (const rtl::Design& design : rtl::designs()) choose(design);
  const auto is_float = [](const rtl::Design* design) { return design->is_float(); };
  if (command.bits && std::all_of(designs.begin(), designs.end(), is_float))
    throw std::runtime_error("--bits: no design named takes it; float designs have fp32 only");
  for (const rtl::Design* design : designs)
    static_cast<void>(design->evaluate(format_before(command, *design)));
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

/// Of the whole design, those that nothing is demanded of.
Row kept_whole(const sim::FittedUnit& unit) {
  Row names = Row::array();
  for (const rtl::Port& port : unit.ports) {
    const auto& ports = unit.demands.ports;
    const auto bounded = [&](const rtl::PortDemand& demand) { return demand.port == port.name; };
    if (std::none_of(ports.begin(), ports.end(), bounded)) names.push_back(port.name);
  }
  return names;
}

Row record(const sim::FittedUnit& unit, const FitScene& scene, const sim::VectorResult& vectors,
           const sim::CosimResult& result) {
  Row left_out = Row::array();
  for (const sim::LeftOut& left : unit.left_out)
    left_out.push_back(fmt::format("{} ({}): {:.2f} % of the area", left.what, left.why,
                                   percent_of(left.area_um2, unit.price_before.area_um2)));
  Row demands = Row::array();
  for (std::size_t i = 0; i < unit.demands.count(); ++i) demands.push_back(rtl::demand_text(unit.demands, i));
  return {{"design", unit.design->name},
          {"bits", rtl::to_string(unit.format)},
          {"bits_before", rtl::to_string(unit.before)},
          {"dropped_bits", unit.coarse().dropped},
          {"ray_ends", unit.ends()},
          {"endless_extra_box_tests_pct",
           unit.precision ? Row(unit.precision->endless_extra_box_tests_pct) : Row(nullptr)},
          {"formats_measured", unit.precision ? unit.precision->formats_measured : 0},
          {"scene", scene.scene.name},
          {"area_before_mm2", mm2(unit.price_before.area_um2)},
          {"area_after_mm2", mm2(unit.price.area_um2)},
          {"area_saved_pct", percent_of(unit.saved_um2(), unit.price_before.area_um2)},
          {"stages_before", unit.price_before.stages},
          {"stages", unit.price.stages},
          {"area_delay_before_mm2_ns", area_delay(unit.price_before)},
          {"area_delay_mm2_ns", area_delay(unit.price)},
          {"bytes_per_node_before", sim::bytes_per_node(unit.before)},
          {"bytes_per_node", sim::bytes_per_node(unit.format, unit.coarse())},
          {"rays", result.rays_primary + result.rays_secondary + result.rays_shadow},
          {"box_tests", result.unit.box_tests},
          {"extra_box_tests_pct", result.extra_box_tests_pct()},
          {"different_triangles", result.different_triangles},
          {"false_misses", unit.design->is_float() ? Row(nullptr) : Row(result.unit.false_misses)},
          {"rtl_mismatches", result.unit.rtl_mismatches},
          {"vectors", vectors.vectors},
          {"vector_hits", vectors.hits},
          {"vector_mismatches", vectors.mismatches},
          {"demands", demands},
          {"kept_whole", kept_whole(unit)},
          {"left_out", left_out}};
}

std::string reports_text(const std::vector<FitReport>& reports, const FitScene& scene, Format format) {
  if (format == Format::text) return fit_text(scene.scene.name, scene.demands, reports);
  std::vector<Row> rows;
  for (const FitReport& report : reports) rows.push_back(report.row);
  return table_text(rows, format);
}

std::optional<sim::Precision> precision_of(const FitCommand& command, const rtl::Design& design,
                                           const FitScene& scene, const sim::SceneRays& rays) {
  if (command.keep_bits) return std::nullopt;
  const rtl::Format before = format_before(command, design);
  return sim::fewest_bits({.design = &design,
                           .scene = &scene.scene,
                           .bvh = &scene.bvh,
                           .demands = &scene.demands,
                           .rays = &rays,
                           .most = before.is_float() ? hls::IntBits{} : before.bits(),
                           .overhead_pct = command.overhead_pct,
                           .threads = command.scene.threads});
}

FitReport fit_design(const FitCommand& command, const rtl::Design& design, const FitScene& scene,
                     const sim::SceneRays& rays) {
  const rtl::Library& library = rtl::Library::thesis();
  const std::string name(design.name);
  std::optional<Progress> progress(name + ": looking for the fewest bits");
  const rtl::Format before = format_before(command, design);
  sim::FittedUnit unit =
      sim::fit(design, before, precision_of(command, design, scene, rays), scene.demands, library);
  std::stable_sort(unit.left_out.begin(), unit.left_out.end(),
                   [](const auto& a, const auto& b) { return a.area_um2 > b.area_um2; });
  std::vector<rtl::File> files = sim::fitted_files(unit, library);
  progress.emplace(name + ": compiling the Verilog");
  const sim::VerilatedDesign verilated(design, unit.format, unit.pipeline, files.front().contents);
  for (rtl::File& drawing : rtl::draw(files)) files.push_back(std::move(drawing));
  host::write_files(fs::path(command.out) / name, files);
  const auto show = [&](double share) { progress->show(share); };
  progress.emplace(name + ": sending vectors");
  const sim::VectorResult vectors = sim::check_vectors({.verilated = &verilated,
                                                        .evaluate = design.evaluate(unit.format),
                                                        .ports = &unit.ports,
                                                        .demands = &unit.demands,
                                                        .vectors = command.vectors,
                                                        .progress = show});
  progress.emplace(name + ": co-simulating");
  const sim::OperandGuard guard(unit.demands, unit.ports);
  const sim::CosimResult result = sim::cosimulate(design, unit.format, verilated, scene.scene, scene.bvh,
                                                  {.width = command.scene.width,
                                                   .height = command.scene.height,
                                                   .threads = command.scene.threads,
                                                   .referee = !design.is_float(),
                                                   .light = command.light,
                                                   .coarse = unit.coarse(),
                                                   .ends = unit.ends(),
                                                   .scene_demands = &scene.demands,
                                                   .guard = &guard,
                                                   .progress = show});
  return {record(unit, scene, vectors, result), unit.left_out, vectors.first_mismatch};
}

sim::SceneRays traced_rays(const FitCommand& command, const FitScene& scene) {
  Progress progress("tracing the scene's rays");
  sim::SceneRays rays = sim::scene_rays(scene.scene, scene.bvh,
                                        {.width = command.scene.width,
                                         .height = command.scene.height,
                                         .threads = command.scene.threads,
                                         .light = command.light,
                                         .progress = [&](double share) { progress.show(share); }});
  const auto hits = [](const ref::RecordedBatch& batch) {
    return std::any_of(batch.triangles.begin(), batch.triangles.end(),
                       [](std::uint32_t triangle) { return triangle != ref::Hit::none; });
  };
  if (std::none_of(rays.batches.begin(), rays.batches.end(), hits))
    throw std::runtime_error(
        fmt::format("scene {}: no ray of the image meets a triangle; a unit fitted to it "
                    "would be of no use",
                    scene.scene.name));
  return rays;
}

int fit(const FitCommand& command) {
  const std::vector<const rtl::Design*> designs = chosen_designs(command);
  std::optional<Progress> progress("reading the scene");
  const FitScene scene = load(command);
  progress.reset();
  const sim::SceneRays rays = traced_rays(command, scene);
  // Before the long run: a folder that cannot be written to is known at once.
  host::make_folder(command.out);
  std::vector<FitReport> reports;
  for (const rtl::Design* design : designs) reports.push_back(fit_design(command, *design, scene, rays));
  fmt::print("{}", reports_text(reports, scene, command.format));
  int exit_code = 0;
  for (const FitReport& report : reports) {
    const std::string wrong = wrong_text(report);
    if (wrong.empty()) continue;
    fmt::print(stderr, "hitpipe: {}\n", wrong);
    exit_code = 1;
  }
  return exit_code;
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
      ->allow_extra_args(false)
      ->type_name("NAME,...");
  command
      ->add_option("--overhead", options->overhead_pct,
                   "Most extra box tests that fewer bits, or rays without ends, may cost, in percent")
      ->check(overhead_problem)
      ->capture_default_str()
      ->type_name("P");
  command
      ->add_option("--bits", options->bits,
                   "Number format of integer designs before the fit; 24/24 unless given")
      ->type_name("n/t");
  command->add_flag("--keep-bits", options->keep_bits, "Leave the number format as it is");
  command
      ->add_option("--vectors", options->vectors,
                   "Random vectors within the demands that are sent through the Verilog; 0: none")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000}).description(""))
      ->capture_default_str()
      ->type_name("N");
  add_folder_option(*command, options->out, "Folder for each design's Verilog, manifest and testbench")
      ->required();
  add_format_option(*command, options->format);
  command->callback([options, &exit_code] { exit_code = fit(*options); });
}

}  // namespace hitpipe::cli
