#include <filesystem>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/experiment_options.hpp"
#include "cli/options/values.hpp"
#include "cli/pieces/pieces.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "host/text.hpp"
#include "thesis/reproduction_page.hpp"
#include "thesis/result_file.hpp"
#include "thesis/result_text.hpp"

namespace hitpipe::cli {

namespace {

struct TableCommand {
  std::vector<std::string> numbers;
  bool judge = false;
  thesis::ExperimentOptions experiment;
  PiecesChoice pieces;
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

std::filesystem::path figures_of(std::filesystem::path page) {
  return page.replace_extension(".csv");
}

void announce_page(const TableCommand& command) {
  if (command.out.empty()) return;
  if (std::filesystem::path(command.out).extension() != ".md")
    throw CLI::ValidationError("--out", command.out + " does not end in .md");
  host::announce_output("--out", figures_of(command.out));
}

/// Prints the page, or writes it. `asked` is the command that makes these tables.
void report(const TableCommand& command, const std::vector<thesis::ResultTable>& tables,
            const std::string& asked) {
  const std::string text = thesis::reproduction_page(tables, asked);
  if (command.out.empty() || command.format != OutputFormat::text)
    fmt::print("{}", command.format == OutputFormat::text
                         ? text
                         : table_text(thesis::reproduction_rows(tables), command.format));
  if (command.out.empty()) return;
  const std::filesystem::path page(command.out);
  host::write_files(page.has_parent_path() ? page.parent_path() : ".",
                    {{page.filename().string(), text},
                     {figures_of(page).filename().string(),
                      table_text(thesis::reproduction_rows(tables), OutputFormat::csv)}});
}

void judge(const TableCommand& command, const CLI::App& parsed) {
  const std::vector<const thesis::Experiment*> experiments = judged(command);
  const auto results = [&](host::Piece piece) {
    std::vector<thesis::ResultTable> tables;
    const host::Piece::Range mine = piece.range(experiments.size());
    for (std::uint64_t i = mine.first; i < mine.end; ++i)
      tables.push_back(table_of(*experiments[i], command));
    return tables;
  };
  do_work(
      {parsed, command.pieces, command.out, experiments.size(), "tables"},
      [&](host::Piece piece) {
        Row rows = Row::array();
        for (const thesis::ResultTable& table : results(piece)) rows.push_back(thesis::kept_result(table));
        return rows;
      },
      [&] {
        announce_page(command);
        report(command, results({}), joined_command(whole_command(parsed), command.out));
        return 0;
      });
}

void join(const TableCommand& command, const CLI::App& parsed) {
  announce_page(command);
  const std::vector<PieceFile> pieces = joined_pieces(parsed, command.pieces);
  std::vector<thesis::ResultTable> tables;
  for (const PieceFile& piece : pieces)
    result_of(piece, [&](const Row& rows) {
      for (const Row& row : rows) tables.push_back(thesis::parse_result(row));
    });
  report(command, tables, joined_command(pieces.front().note.command, command.out));
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
  add_format_option(*command, options->format);
  add_pieces_options(*command, options->pieces, options->out, Output::file,
                     "With --judge: page to write, ending in .md; every figure goes to a .csv beside it. "
                     "Without it the page goes to standard output")
      ->needs(judges);
  for (const char* const option : {"--pieces", "--piece", "--join"})
    command->get_option(option)->needs(judges);
  add_examples(*command, {"hitpipe table 7.2", "hitpipe table --judge --out thesis.md"});
  command->callback([options, command] {
    if (!options->judge) return print_table(*options);
    options->pieces.join.empty() ? judge(*options, *command) : join(*options, *command);
  });
  return command;
}

}  // namespace hitpipe::cli
