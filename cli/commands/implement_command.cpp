#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/commands/board_chips.hpp"
#include "cli/options/board_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/implement_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/implementation_text.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/talk.hpp"
#include "host/text.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "sim/implement/clocks.hpp"
#include "sim/implement/fitting_option.hpp"
#include "sim/implement/unit_implementation.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

/// The value of --clock-ps that tries several.
constexpr const char* automatic = "auto";

struct ImplementCommand {
  DesignChoice choice;
  std::string target;
  BoardChoice board;
  sim::ImplementOptions options;
  bool tries_clocks = false;
  OutputFormat format = OutputFormat::text;
};

Row record(const ImplementCommand& command, const sim::Target& target, const sim::Implementation& unit) {
  const rtl::Design& design = command.choice.design();
  const std::optional<double> fmax = unit.fmax_mhz();
  const int interval = command.options.interval;
  Row row{{"design", design.name},   {"bits", to_string(command.choice.format())},
          {"target", target.name},   {"chip", target.chip},
          {"library", unit.library}, {"flow_control", rtl::flow_control_name(command.options.flow_control)},
          {"module", unit.module},   {"latency", unit.latency}};
  if (interval > 1) row["ii"] = interval;
  row.update(taken_row(unit));
  row.update(
      {{"latency_ns", unit.critical_path_ns ? rounded(unit.latency * *unit.critical_path_ns) : Row(nullptr)},
       {"boxes_per_test", design.kind.objects},
       {"million_hits_per_s", fmax ? rounded(*fmax * design.kind.objects / interval) : Row(nullptr)},
       {"energy_pj_per_box",
        unit.energy ? rounded(unit.energy->pj_per_test / design.kind.objects) : Row(nullptr)},
       {"energy_estimate_pj_per_box", unit.estimated_pj_per_test
                                          ? rounded(*unit.estimated_pj_per_test / design.kind.objects)
                                          : Row(nullptr)},
       {"energy_sequential_pct", unit.energy ? rounded(unit.energy->sequential_pct) : Row(nullptr)},
       {"cycles_per_test", unit.energy ? rounded(unit.energy->cycles_per_test) : Row(nullptr)},
       {"netlist", unit.simulated ? Row(unit.simulated->said) : Row(nullptr)}});
  row.update(tools_row(unit));
  return row;
}

/// A schedule that was tried.
struct TriedClock {
  int clock_ps;
  std::string folder;
  sim::Implementation unit;
  std::string wrong;

  /// Whether it is the better choice.
  [[nodiscard]] bool beats(const TriedClock& other) const {
    if (wrong.empty() != other.wrong.empty()) return wrong.empty();
    if (unit.fmax_mhz() && other.unit.fmax_mhz()) return *unit.fmax_mhz() > *other.unit.fmax_mhz();
    return unit.synthesis.cell_count() < other.unit.synthesis.cell_count();
  }
};

constexpr std::size_t most_clocks = 6;

std::vector<TriedClock> try_clocks(const ImplementCommand& command, const sim::Target& target,
                                   const sim::ImplementOptions& given) {
  const rtl::Design& design = command.choice.design();
  const Format format = command.choice.format();
  const rtl::Library library = given.library_for(target);
  std::vector<TriedClock> tried;
  for (const int clock_ps : sim::clocks_to_try(design.trace(format), library, most_clocks)) {
    sim::ImplementOptions options = given;
    options.clock_ps = clock_ps;
    options.folder = command.options.folder / fmt::format("{}ps", clock_ps);
    options.progress = [&](const std::string& step) {
      given.progress(fmt::format("{} ps: {}", clock_ps, step));
    };
    sim::Implementation unit = sim::implement_unit(design, format, target, options);
    std::string why = fault_of(target, unit);
    tried.push_back({clock_ps, options.folder.string(), std::move(unit), std::move(why)});
  }
  return tried;
}

/// A row for each schedule.
std::vector<Row> clock_rows(const std::vector<TriedClock>& tried) {
  std::vector<Row> rows;
  for (const TriedClock& each : tried) {
    Row row{{"clock_ps", each.clock_ps}, {"latency", each.unit.latency}};
    for (const sim::ResourceCount& count : each.unit.counts) row[count.name] = count.used;
    row["cells"] = each.unit.synthesis.cell_count();
    row["fmax_mhz"] = rounded(each.unit.fmax_mhz());
    row["wrong"] = each.wrong.empty() ? Row(nullptr) : Row(each.wrong);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Columns of figures alone; what is wrong stands below.
std::string clock_table(const std::vector<TriedClock>& tried) {
  std::vector<Row> rows = clock_rows(tried);
  std::string below;
  for (Row& row : rows) {
    if (!row["wrong"].is_null())
      below += host::wrapped(
          fmt::format("{} ps: {}", row["clock_ps"].get<int>(), row["wrong"].get<std::string>()), 2);
    row.erase("wrong");
    if (row["fmax_mhz"].is_null()) row["fmax_mhz"] = "-";
  }
  return table_text(rows, OutputFormat::text) + below + "\n";
}

int implement(const ImplementCommand& command) {
  if (!command.board.name.empty()) {
    if (command.tries_clocks)
      throw std::runtime_error(
          fmt::format("--clock-ps {}: {} has a clock of its own; leave the option out or give a number",
                      automatic, command.board.name));
    return implement_on_board(command.choice, command.board, command.options, command.format);
  }
  const rtl::Design& design = command.choice.design();
  const Format format = command.choice.format();
  const sim::Target target = sim::target_called(command.target);
  sim::ImplementOptions options = command.options;
  std::optional<Progress> progress;
  options.progress = [&](const std::string& step) { progress.emplace(step); };
  std::vector<TriedClock> tried;
  if (command.tries_clocks) tried = try_clocks(command, target, options);
  const auto best = std::max_element(tried.begin(), tried.end(),
                                     [](const TriedClock& a, const TriedClock& b) { return b.beats(a); });
  const sim::Implementation unit =
      tried.empty() ? sim::implement_unit(design, format, target, options) : best->unit;
  progress.reset();

  Row row = record(command, target, unit);
  const fs::path folder = (tried.empty() ? options.folder : fs::path(best->folder)) / target.name;
  if (!tried.empty()) {
    row["clock_ps"] = best->clock_ps;
    row["tried"] = clock_rows(tried);
    if (command.format == OutputFormat::text) fmt::print("{}", clock_table(tried));
  }
  keep_and_print(row, folder / (unit.module + "_implementation.json"), command.format);
  if (!unit.drawn) host::note(std::string(rtl::not_drawn));
  std::string what = fault_of(target, unit);
  if (what.empty()) return 0;
  if (!unit.excess().empty() && (!unit.simulated || unit.simulated->agrees)) {
    if (!tried.empty()) options.clock_ps = best->clock_ps;
    what += "; " + sim::fitting_option(design, format, target, options, unit);
    progress.reset();
  }
  fmt::print(stderr, "hitpipe: {} {} {}\n", design.name, to_string(format), what);
  return 1;
}

}  // namespace

CLI::App* add_implement_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("implement", "Map a unit to a chip or standard cells: counts, clock, netlist");
  const auto options = std::make_shared<ImplementCommand>();
  sim::ImplementOptions& how = options->options;
  add_design_options(*command, options->choice);
  CLI::Option* const design = command->get_option("design")->required(false);
  design->description("A name that `hitpipe list designs` shows. Default: the usual unit of the board");
  CLI::Option* const target = add_target_option(*command, options->target)->needs(design);
  CLI::Option* const board =
      add_board_option(*command, options->board,
                       "Make a bitstream for a board, in which the unit stands behind a serial line");
  exclude(target, board, "a board has a target of its own");
  needs_one_of(*command, {target, board});
  add_baud_option(*command, options->board)->needs(board);
  add_implement_options(*command, how);
  add_block_luts_option(*command, how.block_luts);
  command
      ->add_option_function<std::string>(
          "--clock-ps",
          [options](const std::string& text) {
            options->tries_clocks = text == automatic;
            if (!options->tries_clocks) options->options.clock_ps = std::stoi(text);
          },
          fmt::format(
              "Clock period in picoseconds for the schedule (1 to 1000000000); by default what the slowest "
              "component needs, on iCE40 up to a quarter more, on a board three quarters of its clock. With "
              "`{}` up to {} schedules are tried, each in a folder of its own, and the fastest that fits is "
              "the result",
              automatic, most_clocks))
      ->transform(CLI::Validator(
          [](std::string& text) {
            return text == automatic ? std::string() : number_from(1, 1'000'000'000)(text);
          },
          ""))
      ->type_name("PS|auto");
  add_flow_control_option(*command, how.flow_control);
  add_interval_option(*command, how.interval);
  add_seeds_option(*command, how.seeds, ". With 0 the unit is not placed");
  exclude(add_count_option(
              *command, "--simulate", how.simulate, {1, 10'000'000},
              "Simulate the mapped netlist with N vectors, as `hitpipe rtl --vectors` chooses them, and "
              "compare it with the C++"),
          board, "the vectors are for the unit alone, and on a board it stands behind a serial line");
  add_choice_option<sim::Simulator>(
      *command, "--simulator", how.simulator,
      {{"icarus", sim::Simulator::icarus}, {"verilator", sim::Simulator::verilator}},
      "What simulates the netlist");
  add_seed_option(*command, how.seed);
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe implement int_slabs --target ice40_up5k --out chip",
                          "hitpipe implement int_major --target xc7 --simulate 1000 --out chip"});
  command->callback([options, &exit_code] { exit_code = implement(*options); });
  return command;
}

}  // namespace hitpipe::cli
