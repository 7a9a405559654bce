#include <memory>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/price.hpp"
#include "area_model/triangle_unit.hpp"
#include "cli/commands.hpp"
#include "cli/commands/machines.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/area_text.hpp"
#include "cli/text/help.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/component/library.hpp"

namespace hitpipe::cli {

namespace {

using area::Account;
using area::Price;

struct AreaOptions {
  DesignsChoice units;
  Account account = Account::built;
  rtl::FlowControl flow_control = rtl::FlowControl::stall;
  std::string library{rtl::default_library};
  std::optional<int> block_luts;
  OutputFormat format = OutputFormat::text;
  bool by_stage = false;
  std::vector<int> intervals;
  bool triangle = false;
};

struct ChosenUnit {
  const rtl::Design* design;
  Format format;
};

/// The units of Table 7.2, unless the user names units.
std::vector<ChosenUnit> chosen(const AreaOptions& options) {
  std::vector<ChosenUnit> units;
  if (!options.units.names.empty()) {
    const auto any = [](const rtl::Design&) { return std::string(); };
    const auto own = [](const rtl::Design& design) { return std::vector{design.default_format}; };
    for (const sim::DesignFormats& each : options.units.formats(options.units.designs(any), own))
      for (const Format& format : each.formats) units.push_back({each.design, format});
  } else if (!options.triangle) {
    for (const area::Entry& entry : area::table_7_2())
      units.push_back({&rtl::find_design(entry.design), entry.format});
  }
  if (options.triangle) units.push_back({&area::triangle_unit(), area::triangle_unit().default_format});
  return units;
}

/// A line for each unit that would take more blocks if they were worth no lookup tables.
std::string other_plans(const std::vector<ChosenUnit>& units, const std::vector<RatedPrice>& prices,
                        const rtl::Library& library, const AreaOptions& options) {
  if (!library.chip()->block) return "";
  const rtl::Block& block = *library.chip()->block;
  const rtl::Library free_blocks = library.with_block_luts(0);
  std::string text;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto& [design, format] = units[i];
    const rtl::ChipCells other =
        area::price(*design, format, free_blocks, options.account, options.flow_control).taken;
    if (other.blocks == prices[i].price.taken.blocks) continue;
    text += fmt::format("{} {} with --block-luts 0: {} {}, {} LUT, {} FF\n", design->name, to_string(format),
                        other.blocks, block.name, other.luts, other.registers);
  }
  if (!text.empty())
    text = fmt::format("A product's odd bits take a block where logic would take more than {} LUT.\n{}",
                       block.luts, text);
  return text;
}

/// The machines among the names that the user gave. Throws std::runtime_error, one line, when only some are.
std::vector<const rtl::Machine*> machines_in(const AreaOptions& options) {
  std::vector<const rtl::Machine*> machines;
  for (const std::string& name : options.units.names)
    if (const rtl::Machine* const machine = rtl::machine_called(name)) machines.push_back(machine);
  if (!machines.empty() && machines.size() != options.units.names.size())
    throw std::runtime_error(fmt::format(
        "area: {} is a machine, which has other columns than a design; allowed are machines alone",
        machines.front()->name));
  if (!machines.empty() && options.units.bits.size() > 1)
    throw std::runtime_error("area: several formats; allowed is one with machines");
  return machines;
}

void print_prices(const AreaOptions& options) {
  const rtl::Library library = rtl::library_called(options.library, options.block_luts);
  const auto priced = [&](const rtl::Design& design, const Format& format, int interval) {
    return area::price(design, format, library, options.account, options.flow_control, interval);
  };
  AreaTable table{.units = {}, .library = &library, .rates = !options.intervals.empty()};
  const std::vector<ChosenUnit> units = chosen(options);
  for (const auto& [design, format] : units) {
    const Price every_cycle = priced(*design, format, 1);
    for (const int interval : table.rates ? options.intervals : std::vector{1})
      table.units.push_back({interval == 1 ? every_cycle : priced(*design, format, interval), every_cycle});
  }
  if (!table.rates && library.chip() == nullptr && area::can_price_baseline(library)) {
    const area::Entry& entry = area::baseline_design();
    table.baseline = priced(rtl::find_design(entry.design), entry.format, 1);
  }
  if (options.format != OutputFormat::text)
    fmt::print("{}", table_text(options.by_stage ? stage_rows(table, options.format)
                                                 : area_rows(table, options.format),
                                options.format));
  else if (options.by_stage)
    fmt::print("{}", by_stage_text(table));
  else
    fmt::print("{}", area_text(table, library.chip() != nullptr && !table.rates
                                          ? other_plans(units, table.units, library, options)
                                          : ""));
}

}  // namespace

CLI::App* add_area_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command =
      program.add_subcommand("area", "Price units or machines: area, stages, delay, cells of a chip");
  const auto options = std::make_shared<AreaOptions>();
  CLI::Option* const designs = add_designs_option(*command, options->units, "the six of Table 7.2");
  add_bits_option(*command, options->units, "each design's own")->needs(designs);
  add_choice_option<Account>(*command, "--account", options->account,
                             {{"printed", Account::printed}, {"built", Account::built}},
                             "built: all that is emitted; printed: counted as the thesis counts");
  add_library_option(*command, options->library);
  add_block_luts_option(*command, options->block_luts);
  CLI::Option* const flow =
      add_flow_control_option(*command, options->flow_control,
                              ". Registers with an enable cost more where the library has latch_enable");
  add_format_option(*command, options->format);
  CLI::Option* const by_stage =
      command->add_flag("--by-stage", options->by_stage, "Components and area of every pipeline stage");
  exclude(add_intervals_option(
              *command, options->intervals,
              "area against rate, for units that take a test every N cycles and share components"),
          by_stage, "a shared component works in several stages");
  command->add_flag("--triangle", options->triangle,
                    "Price a float triangle test too, which hitpipe does not emit");
  of_units(*command, {"--account", "--block-luts", "--flow-control", "--by-stage", "--ii", "--triangle"});
  add_examples(*command, {"hitpipe area", "hitpipe area int_slabs,int_major --library ice40 --ii 1,4"});
  command->callback([options, flow, command] {
    if (flow->count() > 0 && options->account == Account::printed)
      throw std::runtime_error(
          "--flow-control: the printed account counts latches as the thesis does; allowed with --account "
          "built");
    const std::vector<const rtl::Machine*> machines = machines_in(*options);
    if (machines.empty()) {
      print_prices(*options);
      return;
    }
    refuse_of_units(*command, *machines.front());
    print_machine_prices(
        machines, options->units.bits.empty() ? std::nullopt : std::optional(options->units.bits.front()),
        options->library, options->format);
  });
  return command;
}

}  // namespace hitpipe::cli
