#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/stiffness_report.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "sim/software.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::cli {

namespace {

struct StiffnessCommand {
  DesignsChoice units;
  std::string scene;
  std::uint64_t tests = 60'000;
  std::uint64_t rays = 2'000;
  std::uint64_t seed = 1;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string out;
  Format format = Format::text;
};

constexpr std::size_t most_formats = 8;  // a table has 80 columns

struct CountedScene {
  ref::Scene scene;
  ref::Bvh bvh;
};

/// The conservative designs, unless the user names designs. A wrong name or format is reported here, before
/// the long run.
std::vector<MeasuredDesign> chosen(const StiffnessCommand& command) {
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
    for (const rtl::Format& format : each.formats)
      made.formats.push_back({.format = format, .boxes = {}, .all_boxes = {}, .traversals = {}});
    measured.push_back(std::move(made));
  }
  return measured;
}

void measure(const StiffnessCommand& command, const CountedScene* loaded,
             std::vector<MeasuredDesign>& designs) {
  for (MeasuredDesign& d : designs) {
    for (Measured& m : d.formats) {
      Progress progress(fmt::format("{} {}", d.design->name, rtl::to_string(m.format)));
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

void write(const StiffnessCommand& command, const std::vector<MeasuredDesign>& designs,
           const std::vector<Row>& rows, const std::string& scene) {
  std::vector<host::File> files{{"stiffness.csv", table_text(rows, Format::csv)},
                                {"stiffness.svg", draw_plot(boxes_plot(designs))}};
  if (!scene.empty()) {
    files.push_back({"stiffness_scene.svg", draw_plot(traversals_plot(designs, scene))});
  }
  host::write_files(command.out, files);
}

int report(const StiffnessCommand& command) {
  std::vector<MeasuredDesign> designs = chosen(command);
  std::optional<CountedScene> loaded;
  if (!command.scene.empty()) {
    const Progress progress("reading the scene");
    loaded.emplace(CountedScene{ref::load_scene(command.scene), {}});
    loaded->bvh = ref::build_bvh(loaded->scene.mesh);
  }
  const std::string scene = loaded ? loaded->scene.name : "";
  measure(command, loaded ? &*loaded : nullptr, designs);
  const std::vector<Row> rows = stiffness_rows(designs, scene);
  if (!command.out.empty()) write(command, designs, rows, scene);
  fmt::print("{}", command.format == Format::text ? stiffness_text(designs, scene)
                                                  : table_text(rows, command.format));
  const std::uint64_t wrong = wrong_answers(designs);
  if (wrong == 0) return 0;
  fmt::print(stderr,
             "hitpipe: {} false misses or different triangles of designs that never miss; all must be 0\n",
             wrong);
  return 1;
}

}  // namespace

void add_stiffness_command(CLI::App& program, int& exit_code) {
  CLI::App* const command = program.add_subcommand(
      "stiffness", "Measure false hits as the components of a ray's direction grow apart");
  const auto options = std::make_shared<StiffnessCommand>();
  add_designs_option(*command, options->units)
      ->description("Names that `hitpipe designs` lists (default: those that never miss)");
  add_bits_option(*command, options->units, "24/24, 20/24, 16/16 and 12/12 for n/t designs. At most 8");
  command
      ->add_option("--scene", options->scene,
                   "Also count the box tests of stiff rays through a built-in scene or a mesh file")
      ->type_name("NAME|FILE");
  add_large_count_option(*command, "--tests", options->tests, 1, 1'000'000'000,
                         "Boxes for each ratio (1 to 10^9)");
  add_large_count_option(*command, "--rays", options->rays, 1, 1'000'000'000,
                         "Rays through the scene for each ratio (1 to 10^9)");
  add_seed_option(*command, options->seed);
  add_count_option(*command, "--threads", options->threads, {1, 1024},
                   "Number of threads; results do not depend on it")
      ->capture_default_str();
  add_folder_option(*command, options->out, "Folder for the rows as CSV and for the plots as SVG");
  add_format_option(*command, options->format);
  command->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace hitpipe::cli
