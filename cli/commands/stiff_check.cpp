#include "cli/commands/stiff_check.hpp"

#include <algorithm>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/text/csv_metadata.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/stiffness_report.hpp"
#include "host/files.hpp"
#include "sim/software.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::cli {

namespace {

constexpr std::size_t most_formats = 8;  // a table has 80 columns

struct CountedScene {
  ref::Scene scene;
  ref::Bvh bvh;
};

/// The conservative designs, unless the user names designs. A wrong name or format is reported here, before
/// the long run.
std::vector<MeasuredDesign> chosen_designs(const StiffCheck& command) {
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

void measure(const StiffCheck& command, const CountedScene* loaded, std::vector<MeasuredDesign>& designs) {
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

void write(const StiffCheck& command, const std::vector<MeasuredDesign>& designs,
           const std::vector<Row>& rows, const std::string& scene, const Row& notes) {
  std::vector<host::File> files{
      {"stiffness.csv", table_text(rows, OutputFormat::csv)},
      {metadata_file("stiffness.csv").string(), csv_metadata({"stiffness.csv"}, notes)},
  };
  const auto draw = [&](const Plot& plot) {
    const std::vector<host::File> drawn =
        picture_files(draw_picture("check", stiffness_picture(plot, command.pictures), command.pictures));
    files.insert(files.end(), drawn.begin(), drawn.end());
  };
  draw(boxes_plot(designs));
  if (!scene.empty()) draw(traversals_plot(designs, scene));
  host::write_files(command.out, files);
}

}  // namespace

int check_stiff_rays(const StiffCheck& command, const Row& notes) {
  std::vector<MeasuredDesign> designs = chosen_designs(command);
  std::optional<CountedScene> loaded;
  if (!command.scene.empty()) {
    const Progress progress("reading the scene");
    loaded.emplace(CountedScene{ref::load_scene(command.scene), {}});
    loaded->bvh = ref::make_hierarchy(loaded->scene, command.hierarchy).bvh;
  }
  const std::string scene = loaded ? loaded->scene.name : "";
  measure(command, loaded ? &*loaded : nullptr, designs);
  const std::vector<Row> rows = stiffness_rows(designs, scene);
  if (!command.out.empty()) write(command, designs, rows, scene, notes);
  fmt::print("{}", command.format == OutputFormat::text ? stiffness_text(designs, scene)
                                                        : table_text(rows, command.format));
  if (command.format == OutputFormat::text && loaded) fmt::print("hierarchy: {}\n", command.hierarchy.text());
  const std::uint64_t wrong = wrong_answers(designs);
  if (wrong == 0) return 0;
  fmt::print(stderr,
             "hitpipe: {} false misses or different triangles of designs that never miss; all must be 0\n",
             wrong);
  return 1;
}

}  // namespace hitpipe::cli
