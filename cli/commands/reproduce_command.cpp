#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/options/experiment_options.hpp"
#include "cli/options/values.hpp"
#include "cli/report/reproduction_page.hpp"
#include "cli/text/progress.hpp"
#include "host/files.hpp"
#include "sim/thesis/chapter_7.hpp"

namespace hitpipe::cli {

namespace {

struct ReproduceCommand {
  ref::ExperimentOptions experiment;
  std::vector<std::string> tables;
  std::string out;
  Format format = Format::text;
};

std::vector<const ref::Experiment*> chosen(const ReproduceCommand& command) {
  std::vector<const ref::Experiment*> experiments;
  for (const std::string& number : command.tables)
    experiments.push_back(&ref::find_experiment(number, sim::thesis_experiments()));
  if (experiments.empty())
    for (const ref::Experiment& experiment : sim::thesis_experiments()) experiments.push_back(&experiment);
  return experiments;
}

std::string command_text(const ReproduceCommand& command) {
  std::string text = "hitpipe reproduce" + experiment_options_text(command.experiment);
  if (!command.tables.empty()) text += fmt::format(" --tables {}", fmt::join(command.tables, ","));
  return command.out.empty() ? text : text + " --out " + command.out;
}

void run(const ReproduceCommand& command) {
  const std::filesystem::path page(command.out);
  if (!command.out.empty() && page.extension() != ".md")
    throw CLI::ValidationError("--out", command.out + " does not end in .md");
  std::vector<ref::ResultTable> tables;
  for (const ref::Experiment* const experiment : chosen(command)) {
    Progress progress(fmt::format("table {}", experiment->number));
    ref::ExperimentOptions options = command.experiment;
    options.progress = [&](double share) { progress.show(share); };
    tables.push_back(experiment->run(experiment->number, options));
  }
  const std::string text = reproduction_page(tables, command_text(command));
  if (command.out.empty() || command.format != Format::text)
    fmt::print("{}",
               command.format == Format::text ? text : table_text(reproduction_rows(tables), command.format));
  if (command.out.empty()) return;
  std::filesystem::path figures = page.filename();
  figures.replace_extension(".csv");
  host::write_files(page.has_parent_path() ? page.parent_path() : ".",
                    {{page.filename().string(), text},
                     {figures.string(), table_text(reproduction_rows(tables), Format::csv)}});
}

}  // namespace

void add_reproduce_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command = program.add_subcommand(
      "reproduce", "Run every experiment of the thesis again and judge each statement and figure");
  const auto options = std::make_shared<ReproduceCommand>();
  add_list_option(*command, "--tables", options->tables, "Only these tables (default: all, and the text)",
                  "N");
  add_experiment_options(*command, options->experiment);
  command
      ->add_option("--out", options->out,
                   "Page to write, ending in .md; every figure goes to a .csv beside it (default: the page "
                   "on standard output)")
      ->type_name("FILE");
  add_format_option(*command, options->format);
  command->callback([options] { run(*options); });
}

}  // namespace hitpipe::cli
