#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/experiment_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/result_text.hpp"
#include "sim/thesis/chapter_7.hpp"
#include "sw_ref/thesis/experiment.hpp"

namespace hitpipe::cli {

namespace {

struct TableOptions {
  std::string number;
  ref::ExperimentOptions experiment;
  Format format = Format::text;
};

void run(const TableOptions& options) {
  const ref::Experiment& experiment = ref::find_experiment(options.number, sim::experiments_and_proposals());
  Progress progress("running the experiment");
  ref::ExperimentOptions with_progress = options.experiment;
  with_progress.progress = [&](double share) { progress.show(share); };
  const ref::ResultTable table = experiment.run(experiment.number, with_progress);
  fmt::print("{}", result_text(table, options.format));
}

}  // namespace

void add_table_command(CLI::App& program, int& /*exit_code*/) {
  std::string numbers;
  for (const ref::Experiment& experiment : sim::experiments_and_proposals())
    numbers += (numbers.empty() ? "" : ", ") + std::string(experiment.number);
  CLI::App* const command =
      program.add_subcommand("table", "Run an experiment of the thesis again and print its table");
  const auto options = std::make_shared<TableOptions>();
  command->add_option("number", options->number, "The thesis's table: " + numbers)
      ->required()
      ->type_name("N");
  add_experiment_options(*command, options->experiment);
  add_format_option(*command, options->format);
  command->callback([options] { run(*options); });
}

}  // namespace hitpipe::cli
