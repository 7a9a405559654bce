#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/board_chips.hpp"
#include "cli/options/board_options.hpp"
#include "cli/options/core_options.hpp"
#include "cli/options/implement_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/implementation_text.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "sim/implement/core_implementation.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::cli {

namespace {

struct CoreImplementCommand {
  CoreChoice core;
  std::string target;
  BoardChoice board;
  sim::ImplementOptions options;
  OutputFormat format = OutputFormat::text;
};

/// Of a core alone and behind AXI, which have more pins than a chip that is placed. Returns the exit code.
int map_core(const CoreImplementCommand& command) {
  rtl::CoreOptions core_options = command.core.core();
  core_options.clock_ps = command.options.clock_ps;
  const sim::Target target = sim::target_called(command.target);
  std::optional<Progress> progress;
  sim::ImplementOptions options = command.options;
  options.seeds = 0;
  options.progress = [&](const std::string& step) { progress.emplace(step); };
  const sim::CoreImplementation made = sim::implement_core(core_options, target, options);
  progress.reset();

  const std::string bits = to_string(Format(core_options.bits));
  Row both{{"core", made.core.chip.module}, {"bits", bits},        {"rays", core_options.rays},
           {"target", target.name},         {"chip", target.chip}, {"library", made.core.chip.library},
           {"clock_ps", made.clock_ps}};
  both.update(tools_row(made.core.chip));
  const std::filesystem::path folder = options.folder / target.name;
  std::vector<Row> columns, rows;
  std::string faults;
  for (const sim::MappedCore* const mapped : {&made.core, &made.axi}) {
    const sim::Implementation& chip = mapped->chip;
    Row column{{"module", chip.module}};
    column.update(taken_row(chip));
    column["memory_bits"] = mapped->memory_bits;
    Row row = both;
    row.update(column);
    host::write_file(folder / (chip.module + "_implementation.json"), record_text(row, OutputFormat::json));
    row["files"] = folder.string();
    columns.push_back(std::move(column));
    rows.push_back(std::move(row));
    if (const std::string fault = fault_of(target, chip); !fault.empty())
      faults += fmt::format("hitpipe: {} {} {}\n", chip.module, bits, fault);
  }
  both["files"] = folder.string();
  if (command.format == OutputFormat::text)
    fmt::print("{}\n{}", record_text(without_nothing(both), OutputFormat::text), columns_text(columns));
  else
    fmt::print("{}", table_text(rows, command.format));
  fmt::print(stderr, "{}", faults);
  return faults.empty() ? 0 : 1;
}

}  // namespace

CLI::App* add_core_implement_command(CLI::App& core, int& exit_code) {
  CLI::App* const command =
      core.add_subcommand("implement", "Map a core and its AXI wrapper, or make a bitstream for a board");
  const auto options = std::make_shared<CoreImplementCommand>();
  add_core_bits_option(*command, options->core.bits, to_string(Format(options->core.options.bits)));
  CLI::Option* const target = add_target_option(*command, options->target);
  CLI::Option* const board =
      add_board_option(*command, options->board,
                       "Make a bitstream for a board, which has a core of its own behind a serial line");
  add_baud_option(*command, options->board)->needs(board);
  needs_one_of(*command, {target, board});
  add_implement_options(*command, options->options);
  add_count_option(
      *command, "--clock-ps", options->options.clock_ps, {1, 1'000'000'000},
      "Clock period in picoseconds for the schedule of its units; by default that of the slowest "
      "machine, on a board three quarters of its clock");
  add_seeds_option(*command, options->options.seeds)->needs(board);
  using Group = rtl::CoreOption::Group;
  for (CLI::Option* const option :
       add_core_options(*command, options->core,
                        {Group::rays, Group::core, Group::ports, Group::limits, Group::cache, Group::bus}))
    exclude(option, board, "a board has a core of its own");
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe core implement --target xc7 --out core",
                          "hitpipe core implement --board icebreaker --out core"});
  command->callback([options, &exit_code] {
    exit_code = options->board.name.empty() ? map_core(*options)
                                            : implement_core_on_board(options->core.bits, options->board,
                                                                      options->options, options->format);
  });
  return command;
}

}  // namespace hitpipe::cli
