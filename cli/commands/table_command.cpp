#include <filesystem>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/options/experiment_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "thesis/reproduction_page.hpp"
#include "thesis/result_text.hpp"

namespace hitpipe::cli {

namespace {

struct TableCommand {
  std::vector<std::string> numbers;
  bool judge = false;
  thesis::ExperimentOptions experiment;
  std::string out;
  OutputFormat format = OutputFormat::text;
};

thesis::ResultTable table_of(const thesis::Experiment& experiment, const TableCommand& command) {
  Progress progress(fmt::format("table {}", experiment.number));
  thesis::ExperimentOptions options = command.experiment;
  options.progress = [&](double share) { progress.show(share); };
  return experiment.run(experiment.number, options);
}

void print_table(const TableCommand& command) {
  if (command.numbers.size() != 1)
    throw std::runtime_error(
        fmt::format("table: {} tables; allowed is one, or any number with --judge", command.numbers.size()));
  const thesis::Experiment& experiment =
      thesis::find_experiment(command.numbers.front(), thesis::experiments_and_proposals());
  const thesis::ResultTable table = table_of(experiment, command);
  fmt::print("{}", command.format == OutputFormat::text ? thesis::result_text(table)
                   : command.format == OutputFormat::csv
                       ? table_text(thesis::result_rows(table), OutputFormat::csv)
                       : record_text(thesis::result_record(table), OutputFormat::json));
}

/// The tables that are asked for, or all of the thesis.
std::vector<const thesis::Experiment*> judged(const TableCommand& command) {
  std::vector<const thesis::Experiment*> experiments;
  for (const std::string& number : command.numbers)
    experiments.push_back(&thesis::find_experiment(number, thesis::experiments()));
  if (experiments.empty())
    for (const thesis::Experiment& experiment : thesis::experiments()) experiments.push_back(&experiment);
  return experiments;
}

std::string command_text(const TableCommand& command) {
  std::string text = "hitpipe table --judge";
  if (!command.numbers.empty()) text += fmt::format(" {}", fmt::join(command.numbers, " "));
  text += experiment_options_text(command.experiment);
  return command.out.empty() ? text : text + " --out " + command.out;
}

void judge(const TableCommand& command) {
  const std::filesystem::path page(command.out);
  if (!command.out.empty() && page.extension() != ".md")
    throw CLI::ValidationError("--out", command.out + " does not end in .md");
  std::filesystem::path figures = page;
  figures.replace_extension(".csv");
  if (!command.out.empty()) host::announce_output("--out", figures);
  std::vector<thesis::ResultTable> tables;
  for (const thesis::Experiment* const experiment : judged(command))
    tables.push_back(table_of(*experiment, command));
  const std::string text = thesis::reproduction_page(tables, command_text(command));
  if (command.out.empty() || command.format != OutputFormat::text)
    fmt::print("{}", command.format == OutputFormat::text
                         ? text
                         : table_text(thesis::reproduction_rows(tables), command.format));
  if (command.out.empty()) return;
  host::write_files(
      page.has_parent_path() ? page.parent_path() : ".",
      {{page.filename().string(), text},
       {figures.filename().string(), table_text(thesis::reproduction_rows(tables), OutputFormat::csv)}});
}

}  // namespace

CLI::App* add_table_command(CLI::App& program, int& /*exit_code*/) {
  std::string numbers;
  for (const thesis::Experiment& experiment : thesis::experiments_and_proposals())
    numbers += (numbers.empty() ? "" : ", ") + std::string(experiment.number);
  CLI::App* const command =
      program.add_subcommand("table", "Repeat the experiment of a table, or judge all of the thesis");
  const auto options = std::make_shared<TableCommand>();
  command->add_option("number", options->numbers, "The thesis's table: " + numbers)
      ->delimiter(',')
      ->type_name("N");
  CLI::Option* const judges = command->add_flag(
      "--judge", options->judge,
      "Judge each statement and figure of the thesis, about these tables or about all and the text");
  add_experiment_options(*command, options->experiment);
  as_output(command->add_option(
                "--out", options->out,
                "With --judge: page to write, ending in .md; every figure goes to a .csv beside it. "
                "Without it the page goes to standard output"))
      ->needs(judges);
  add_format_option(*command, options->format);
  command->callback([options] { options->judge ? judge(*options) : print_table(*options); });
  return command;
}

}  // namespace hitpipe::cli
