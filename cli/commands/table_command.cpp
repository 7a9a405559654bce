#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/values.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/result_text.hpp"
#include "sw_ref/experiment/experiment.hpp"

namespace hitpipe::cli {

namespace {

struct TableOptions {
  std::string number;
  ref::ExperimentOptions experiment;
  Format format = Format::text;
};

/// For example "Bunny=bunny.ply".
void add_scene(const std::string& text, ref::ExperimentOptions& options) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw CLI::ValidationError("--scene",
                               fmt::format("{} is not NAME=SCENE; give for example Bunny=bunny.ply", text));
  options.scenes[text.substr(0, equals)] = text.substr(equals + 1);
}

void run(const TableOptions& options) {
  const ref::Experiment& experiment = ref::find_experiment(options.number);
  Progress progress("running the experiment");
  ref::ExperimentOptions with_progress = options.experiment;
  with_progress.progress = [&](double share) { progress.show(share); };
  const ref::ResultTable table = experiment.run(experiment.number, with_progress);
  fmt::print("{}", result_text(table, options.format));
}

}  // namespace

void add_table_command(CLI::App& program, int& /*exit_code*/) {
  std::string numbers;
  for (const ref::Experiment& experiment : ref::experiments())
    numbers += (numbers.empty() ? "" : ", ") + std::string(experiment.number);
  CLI::App* const command =
      program.add_subcommand("table", "Run an experiment of the thesis again and print its table");
  const auto options = std::make_shared<TableOptions>();
  command->add_option("number", options->number, "The thesis's table: " + numbers)
      ->required()
      ->type_name("N");
  command
      ->add_option_function<std::vector<std::string>>(
          "--scene",
          [options](const std::vector<std::string>& given) {
            for (const std::string& text : given) add_scene(text, options->experiment);
          },
          "A mesh, scene file or built-in scene to use for a scene of the thesis; repeat the option for more")
      ->allow_extra_args(false)
      ->type_name("NAME=SCENE");
  add_list_option(*command, "--only", options->experiment.only, "Only these scenes of the thesis", "NAME");
  add_count_option(*command, "--width", options->experiment.width, {1, 16384}, "Pixels across")
      ->capture_default_str();
  add_count_option(*command, "--height", options->experiment.height, {1, 16384}, "Pixels down")
      ->capture_default_str();
  command
      ->add_option("--triangles", options->experiment.triangles,
                   "Triangles of each stand-in that scales (default: its own size)")
      ->type_name("N");
  add_count_option(*command, "--repeats", options->experiment.repeats, {1, 1000},
                   "Timed runs of each kind; the fastest counts")
      ->capture_default_str();
  add_count_option(*command, "--threads", options->experiment.threads, {1, 1024},
                   "Number of threads for counting; timing uses one thread")
      ->capture_default_str();
  add_format_option(*command, options->format);
  command->callback([options] { run(*options); });
}

}  // namespace hitpipe::cli
