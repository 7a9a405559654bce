#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "cli/commands.hpp"
#include "cli/options/cost_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/fit_text.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/sweep_rows.hpp"
#include "host/files.hpp"
#include "host/talk.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "sim/cosim/generic_tracer.hpp"
#include "sim/fit/fit_scene.hpp"
#include "sim/unit/unit_set_up.hpp"

namespace hitpipe::cli {

namespace {

struct FitCommand {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  ref::WhittedOptions light;
  bool no_shadows = false;
  DesignsChoice units;
  std::optional<double> overhead_pct;  ///< without it, the least whole cost decides
  CostChoice cost;
  bool keep_bits = false;
  int interval = 1;
  std::optional<double> rate_boxes;  ///< a second
  std::optional<double> rate_rays;
  std::uint64_t vectors = 1'000'000;
  std::string out;
  OutputFormat format = OutputFormat::text;

  /// With a rate the area alone decides.
  [[nodiscard]] bool least_area() const { return rate_boxes || rate_rays; }
};

/// A design and its format before the fit.
struct Wanted {
  const rtl::Design* design;
  Format before;
};

/// Each design once. Throws before the long run when a name or a number format does not exist.
std::vector<Wanted> chosen_designs(const FitCommand& command) {
  const auto own = [](const rtl::Design& design) { return std::vector{sim::fit_from(design)}; };
  std::vector<Wanted> wanted;
  for (const sim::DesignFormats& each :
       command.units.formats(command.units.designs(sim::why_not_fitted), own)) {
    if (each.formats.size() > 1)
      throw std::runtime_error(fmt::format("--bits: {} formats for {}; a fit starts from one",
                                           each.formats.size(), each.design->name));
    wanted.push_back({each.design, each.formats.front()});
  }
  return wanted;
}

double percent_of(std::int64_t part, std::int64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

double mm2(std::int64_t area_um2) {
  return static_cast<double>(area_um2) * 1e-6;
}

/// Area for each box, times delay, in mm2 ns.
double area_delay(const area::Price& price) {
  return static_cast<double>(price.area_delay_per_box()) * 1e-9;
}

/// The ports of the whole design that no demand names.
Row kept_whole(const sim::FittedUnit& unit) {
  Row names = Row::array();
  for (const rtl::Port& port : unit.ports()) {
    const auto& ports = unit.demands.ports;
    const auto bounded = [&](const rtl::PortDemand& demand) { return demand.port == port.name; };
    if (std::none_of(ports.begin(), ports.end(), bounded)) names.push_back(port.name);
  }
  return names;
}

/// The unit of a step of the search. A test begins whenever one may.
double whole_cost(const sim::PricedTests& unit, const sim::TriangleCost& triangle, bool tests_only) {
  sim::SweepRow row = sim::priced_row(*unit.design, unit.format, unit.price);
  row.triangle = triangle;
  const auto boxes = static_cast<std::uint64_t>(row.boxes_per_test);
  row.box_tests = unit.tests.box_tests;
  row.unit_tests = (row.box_tests + boxes - 1) / boxes;
  row.cycles = row.unit_tests * static_cast<std::uint64_t>(unit.price.interval);
  row.triangle_tests = unit.tests.triangle_tests;
  row.rays_primary = unit.tests.rays;
  if (!tests_only) row.set_up = sim::set_up_cost(*unit.design, unit.format, rtl::Library::thesis());
  return row.whole_area_run_time();
}

sim::SweepRow measured(const sim::FitResult& fitted, const sim::TriangleCost& triangle, bool tests_only) {
  const sim::FittedUnit& unit = fitted.unit;
  sim::SweepRow row = sim::priced_row(*unit.design, unit.format, unit.price);
  row.triangle = triangle;
  if (!tests_only) row.set_up = sim::set_up_cost(*unit.design, unit.format, rtl::Library::thesis());
  row.bytes_per_node =
      static_cast<int>(sim::bytes_per_node(*unit.design, unit.format, sim::coarse_axes(unit)));
  sim::add_counts(row, fitted.image);
  return row;
}

/// What the search for the least cost compared: the format before the fit, other starts, and its result. A cost
/// is null if the unit is too slow for the rate or has too many extra box tests.
void add_search(Row& row, const std::optional<sim::Precision>& precision, bool least_area) {
  const bool searched = precision && !precision->starts.empty();
  const auto cost_of = [](double cost) { return std::isfinite(cost) ? Row(cost) : Row(nullptr); };
  Row starts = Row::array();
  if (searched)
    for (const auto& [format, cost] : precision->starts)
      starts.push_back(to_string(format) +
                       (std::isfinite(cost) ? fmt::format(" {:.4g}", cost) : " beyond a limit"));
  const char* const measure = least_area ? "area in mm²" : "whole cost in mm² ms";
  row.update({{"search_measure", searched ? Row(measure) : Row(nullptr)},
              {"search_starts", starts},
              {"search_cost_before", searched ? cost_of(precision->starts.front().cost) : Row(nullptr)},
              {"search_cost", searched ? cost_of(precision->cost) : Row(nullptr)}});
}

Row known(const std::optional<double>& value) {
  return value ? Row(*value) : Row(nullptr);
}

/// Of units that need not take a test in each cycle, also how often this one does.
Row record(const sim::FitResult& fitted, const sim::SweepRow& counted, const ref::Scene& scene,
           const FitCommand& command) {
  const auto& [unit, vectors, result, rays_per_second, drawn] = fitted;
  Row left_out = Row::array();
  for (const sim::LeftOut& left : unit.left_out)
    left_out.push_back({{"left_out", left.what},
                        {"share_pct", percent_of(left.area_um2, unit.price_before.area_um2)},
                        {"why", left.why}});
  Row demands = Row::array();
  for (std::size_t i = 0; i < unit.demands.count(); ++i) demands.push_back(rtl::demand_text(unit.demands, i));
  Row row{{"design", unit.design->name},
          {"bits", to_string(unit.format)},
          {"bits_before", to_string(unit.before)},
          {"dropped_bits", sim::coarse_axes(unit).dropped},
          {"ray_ends", sim::takes_ends(unit)},
          {"endless_extra_box_tests_pct",
           unit.precision ? known(unit.precision->endless_extra_box_tests_pct) : Row(nullptr)},
          {"formats_measured", unit.precision ? unit.precision->formats_measured : 0}};
  add_search(row, unit.precision, command.least_area());
  row.update({{"scene", scene.name},
              {"hierarchy", command.hierarchy.name()},
              {"area_before_mm2", mm2(unit.price_before.area_um2)},
              {"area_after_mm2", mm2(unit.price.area_um2)},
              {"area_saved_pct", percent_of(unit.saved_um2(), unit.price_before.area_um2)},
              {"stages_before", unit.price_before.stages},
              {"stages", unit.price.stages},
              {"area_delay_before_mm2_ns", area_delay(unit.price_before)},
              {"area_delay_mm2_ns", area_delay(unit.price)},
              {"bytes_per_node_before", sim::bytes_per_node(*unit.design, unit.before)},
              {"bytes_per_node", sim::bytes_per_node(*unit.design, unit.format, sim::coarse_axes(unit))},
              {"rays", result.rays_primary + result.rays_secondary + result.rays_shadow},
              {"box_tests", result.unit.box_tests},
              {"extra_box_tests_pct", result.extra_box_tests_pct()},
              {"extra_box_tests_pct_low", known(counted.extra_box_pct_low)},
              {"extra_box_tests_pct_high", known(counted.extra_box_pct_high)},
              {"triangle_tests", counted.triangle_tests},
              {"extra_triangle_tests_pct", counted.extra_triangle_tests_pct()},
              {"extra_triangle_tests_pct_low", known(counted.extra_triangle_pct_low)},
              {"extra_triangle_tests_pct_high", known(counted.extra_triangle_pct_high)},
              {"bytes_per_ray", counted.bytes_per_ray()},
              {"whole_run_time_ms", counted.whole_run_time_ms()},
              {"whole_area_run_time_mm2_ms", counted.whole_area_run_time_mm2_ms()},
              {"different_triangles", result.different_triangles},
              {"false_misses", result.unit.false_misses ? Row(*result.unit.false_misses) : Row(nullptr)},
              {"rtl_mismatches", result.unit.rtl_mismatches},
              {"vectors", vectors.vectors},
              {"vector_hits", vectors.hits},
              {"vector_mismatches", vectors.mismatches},
              {"demands", demands},
              {"kept_whole", kept_whole(unit)},
              {"left_out", left_out}});
  if (command.interval > 1 || command.least_area())
    row.update({{"ii", unit.price.interval},
                {"boxes_per_second", unit.price.boxes_per_second()},
                {"rays_per_second", std::floor(rays_per_second)}});
  row.update(scene_row(scene));
  return row;
}

std::string reports_text(const std::vector<FitReport>& reports, const std::vector<sim::SweepRow>& counted,
                         const sim::FitScene& scene, const std::string& hierarchy, OutputFormat format) {
  if (format == OutputFormat::text) {
    std::vector<std::string> advice = recommendation(counted);
    advice.push_back(cost_caveat(counted.front()));
    advice.push_back("hierarchy: " + hierarchy);
    advice.push_back("scene: " + summary_of(scene_row(scene.scene)));
    return fit_text(scene.scene.name, scene.demands, reports, advice);
  }
  std::vector<Row> rows;
  for (const FitReport& report : reports) {
    Row& row = rows.emplace_back(report.row);
    if (format == OutputFormat::json) continue;
    for (Row& cut : row.at("left_out"))
      cut = fmt::format("{} ({}): {:.2f} % of the area", cut.at("left_out").get<std::string>(),
                        cut.at("why").get<std::string>(), cut.at("share_pct").get<double>());
  }
  return table_text(rows, format);
}

/// One line for each step, in turn.
class Steps {
 public:
  void show(const std::string& step, double share) {
    if (step != step_) {  // the main thread is the first to report a step
      step_ = step;
      progress_.emplace(step);
    }
    progress_->show(share);
  }
  void end() {
    progress_.reset();
    step_.clear();
  }

 private:
  std::string step_;
  std::optional<Progress> progress_;
};

int fit(const FitCommand& command) {
  const std::vector<Wanted> designs = chosen_designs(command);
  const rtl::Library& library = rtl::Library::thesis();
  const sim::TriangleCost triangle = command.cost.triangle(library);
  Steps steps;
  sim::FitOptions options{
      .width = command.scene.width,
      .height = command.scene.height,
      .threads = command.scene.threads,
      .light = command.light,
      .hierarchy = command.hierarchy,
      .keep_bits = command.keep_bits,
      .rate = {.interval = command.interval, .boxes_per_second = command.rate_boxes.value_or(0)},
      .rays_per_second = command.rate_rays.value_or(0),
      .vectors = command.vectors,
      .folder = command.out,
      .progress = [&](const std::string& step, double share) { steps.show(step, share); }};
  if (command.overhead_pct) {
    options.overhead_pct = *command.overhead_pct;
  } else {
    options.cost = [&](const sim::PricedTests& unit) {
      return whole_cost(unit, triangle, command.cost.tests_only);
    };
  }
  steps.show("reading the scene", 0.0);
  ref::Scene loaded = command.scene.load();
  if (command.no_shadows) loaded.lights.clear();
  const sim::FitScene scene = sim::prepare_fit(std::move(loaded), options);
  // Done before the long run, so that a folder that cannot be written is reported at once.
  host::make_folder(command.out);
  std::vector<FitReport> reports;
  std::vector<sim::SweepRow> counted;
  bool drawn = true;
  for (const Wanted& wanted : designs) {
    const sim::FitResult fitted = sim::fit_to_scene(*wanted.design, wanted.before, scene, options, library);
    drawn = drawn && fitted.drawn;
    counted.push_back(measured(fitted, triangle, command.cost.tests_only));
    reports.push_back({record(fitted, counted.back(), scene.scene, command), fitted.unit.left_out,
                       cost_text(counted.back()), fitted.vectors.first_mismatch});
  }
  steps.end();
  fmt::print("{}", reports_text(reports, counted, scene, command.hierarchy.text(), command.format));
  if (!drawn) host::note(std::string(rtl::not_drawn));
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

CLI::App* add_fit_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("fit", "Make the smallest unit of each design for a scene, and check it");
  const auto options = std::make_shared<FitCommand>();
  add_scene_options(*command, options->scene);
  add_hierarchy_options(*command, options->hierarchy);
  add_light_options(*command, options->light);
  command->add_flag("--no-shadows", options->no_shadows, "Switch the lights off: no shadow rays");
  add_designs_option(*command, options->units, "all");
  command
      ->add_option("--overhead", options->overhead_pct,
                   "Take the fewest bits with at most P percent more box tests, instead of the least whole "
                   "cost. It also limits what rays without ends cost. With a rate it only limits")
      ->transform(number_from(0.0, 1000.0))
      ->type_name("P");
  add_triangle_options(*command, options->cost);
  add_bits_option(*command, options->units, "24/24 for n/t designs. The fit starts from these formats");
  command->add_flag("--keep-bits", options->keep_bits, "Keep the number format");
  CLI::Option* const interval = add_interval_option(*command, options->interval);
  const auto add_rate = [&](const char* name, std::optional<double>& rate, const char* of,
                            const char* limit) {
    return command
        ->add_option(
            name, rate,
            fmt::format(
                "Make the unit of least area that takes R {} a second at the schedule's clock{} (1 to 10^12)",
                of, limit))
        ->transform(number_from(1.0, 1e12))
        ->type_name("R");
  };
  CLI::Option* const boxes = add_rate("--rate-boxes", options->rate_boxes, "boxes",
                                      ", with at most --overhead (2) percent more box tests");
  CLI::Option* const rays = add_rate("--rate-rays", options->rate_rays, "rays of the image", "");
  exclude(boxes, interval, "the rate decides the interval");
  exclude(rays, interval, "the rate decides the interval");
  exclude(rays, boxes, "one rate decides the interval");
  add_large_count_option(*command, "--vectors", options->vectors, 0, 1'000'000'000,
                         "Random vectors, within the demands, that go through the Verilog (0 to 10^9)");
  add_folder_option(*command, options->out, "Folder for each design's Verilog, manifest and testbench")
      ->required();
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe fit int_slabs --scene spheres --out fitted",
                          "hitpipe fit --scene terrain --overhead 2 --out fitted"});
  command->callback([options, &exit_code] {
    options->hierarchy.build.threads = options->scene.threads;
    exit_code = fit(*options);
  });
  return command;
}

}  // namespace hitpipe::cli
