#include <memory>
#include <optional>
#include <set>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/figure.hpp"
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
using area::Line;
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
  rtl::Format format;
};

/// The units of Table 7.2, unless the user names units.
std::vector<ChosenUnit> chosen(const AreaOptions& options) {
  std::vector<ChosenUnit> units;
  if (!options.units.names.empty()) {
    const auto any = [](const rtl::Design&) { return std::string(); };
    const auto own = [](const rtl::Design& design) { return std::vector{design.default_format}; };
    for (const sim::DesignFormats& each : options.units.formats(options.units.designs(any), own))
      for (const rtl::Format& format : each.formats) units.push_back({each.design, format});
  } else if (!options.triangle) {
    for (const area::Entry& entry : area::table_7_2())
      units.push_back({&rtl::find_design(entry.design), entry.format});
  }
  if (options.triangle) units.push_back({&area::triangle_unit(), area::triangle_unit().default_format});
  return units;
}

std::set<area::Part> parts_of(const std::vector<Price>& prices) {
  std::set<area::Part> parts;
  for (const Price& price : prices) {
    for (const Line& line : price.lines) parts.insert(line.part);
  }
  return parts;
}

/// Appends a count for every part, 0 if there is none, and the names of the estimated parts.
void append_parts(Row& row, const std::vector<Line>& lines, const std::set<area::Part>& parts) {
  for (const area::Part& part : parts) row[area::part_name(part)] = 0;
  Row estimated = Row::array();
  for (const Line& line : lines) {
    row[area::part_name(line.part)] = line.n;
    if (line.estimated) estimated.push_back(area::part_name(line.part));
  }
  row["estimated"] = estimated;
}

/// In CSV the figure keeps its zeros at the end. In JSON it is a number.
Row figure(const std::string& digits, OutputFormat format) {
  return format == OutputFormat::csv ? Row(digits) : Row::parse(digits);
}

/// What is said of a unit whatever it is made of.
Row unit_row(const Price& p, OutputFormat format) {
  return {{"design", p.design},
          {"bits", rtl::to_string(p.format)},
          {"stages", p.stages},
          {"stage_delay_ns", figure(area::delay_ns(p.stage_delay_ps), format)},
          {"clock_mhz", figure(area::clock_mhz(p), format)},
          {"latency_ns", figure(area::delay_ns(p.latency_ps()), format)}};
}

std::vector<Row> design_rows(const std::vector<Price>& prices, const std::optional<Price>& baseline,
                             OutputFormat format) {
  const auto share = [&](std::int64_t part, std::int64_t whole) {
    return figure(area::percent(part, whole), format);
  };
  const std::set<area::Part> parts = parts_of(prices);
  std::vector<Row> rows;
  for (const Price& p : prices) {
    Row row = unit_row(p, format);
    row.update(
        {{"area_mm2", figure(area::area_mm2(p.area_um2), format)},
         {"area_pct", baseline ? share(p.area_per_box_um2(), baseline->area_per_box_um2()) : Row(nullptr)},
         {"adp_mm2_ns", figure(area::adp_mm2_ns(p), format)},
         {"adp_pct", baseline ? share(p.area_delay_per_box(), baseline->area_delay_per_box()) : Row(nullptr)},
         {"boxes_per_test", p.boxes},
         {"area_per_box_mm2", figure(area::area_mm2(p.area_per_box_um2()), format)}});
    append_parts(row, p.lines, parts);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> stage_rows(const std::vector<Price>& prices, OutputFormat format) {
  const std::set<area::Part> parts = parts_of(prices);
  std::vector<Row> rows;
  for (const Price& p : prices) {
    for (const area::StagePrice& stage : p.by_stage) {
      Row row{{"design", p.design},
              {"bits", rtl::to_string(p.format)},
              {"stage", stage.stage},
              {"area_mm2", figure(area::area_mm2(stage.area_um2), format)}};
      append_parts(row, stage.lines, parts);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

/// What a unit takes of the chip.
void append_cells(Row& row, const rtl::ChipCells& taken, const rtl::Chip& chip) {
  row["lut"] = taken.luts;
  row["ff"] = taken.registers;
  row["dsp"] = taken.blocks;
  row["dsp_name"] = chip.block ? Row(chip.block->name) : Row(nullptr);
}

std::vector<Row> chip_rows(const std::vector<Price>& prices, const rtl::Library& library,
                           OutputFormat format) {
  const std::set<area::Part> parts = parts_of(prices);
  std::vector<Row> rows;
  for (const Price& p : prices) {
    Row row{{"library", library.name()}};
    row.update(unit_row(p, format));
    row["delay_estimated"] = library.chip()->estimated;
    append_cells(row, p.taken, *library.chip());
    row["logic_cells"] = p.logic_cells ? Row(*p.logic_cells) : Row(nullptr);
    row["boxes_per_test"] = p.boxes;
    append_parts(row, p.lines, parts);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> chip_stage_rows(const std::vector<Price>& prices, const rtl::Library& library) {
  const std::set<area::Part> parts = parts_of(prices);
  std::vector<Row> rows;
  for (const Price& p : prices) {
    for (const area::StagePrice& stage : p.by_stage) {
      Row row{{"library", library.name()},
              {"design", p.design},
              {"bits", rtl::to_string(p.format)},
              {"stage", stage.stage}};
      append_cells(row, stage.taken, *library.chip());
      append_parts(row, stage.lines, parts);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

/// A line for each unit that would take more blocks if they were worth no lookup tables.
std::string other_plans(const std::vector<ChosenUnit>& units, const std::vector<Price>& prices,
                        const rtl::Library& library, const AreaOptions& options) {
  if (!library.chip()->block) return "";
  const rtl::Block& block = *library.chip()->block;
  const rtl::Library free_blocks = library.with_block_luts(0);
  std::string text;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto& [design, format] = units[i];
    const rtl::ChipCells other =
        area::price(*design, format, free_blocks, options.account, options.flow_control).taken;
    if (other.blocks == prices[i].taken.blocks) continue;
    text += fmt::format("{} {} with --block-luts 0: {} {}, {} LUT, {} FF\n", design->name,
                        rtl::to_string(format), other.blocks, block.name, other.luts, other.registers);
  }
  if (!text.empty())
    text = fmt::format("A product's odd bits take a block where logic would take more than {} LUT.\n{}",
                       block.luts, text);
  return text;
}

std::string chip_prices(const std::vector<Price>& prices, const rtl::Library& library,
                        const std::vector<ChosenUnit>& units, const AreaOptions& options) {
  if (options.by_stage) {
    return options.format == OutputFormat::text
               ? chip_by_stage_text(prices, *library.chip())
               : table_text(chip_stage_rows(prices, library), options.format);
  }
  return options.format == OutputFormat::text
             ? chip_text(prices, library, other_plans(units, prices, library, options))
             : table_text(chip_rows(prices, library, options.format), options.format);
}

std::vector<Row> rate_rows(const std::vector<RatedPrice>& units, const rtl::Library& library,
                           OutputFormat format) {
  std::set<area::Part> parts;
  for (const RatedPrice& unit : units) parts.merge(parts_of({unit.price}));
  std::vector<Row> rows;
  for (const auto& [p, every_cycle] : units) {
    Row row = unit_row(p, format);
    row["ii"] = p.interval;
    row["boxes_per_test"] = p.boxes;
    row["boxes_per_second"] = p.boxes_per_second();
    if (library.chip() != nullptr) {
      append_cells(row, p.taken, *library.chip());
      row["logic_cells"] = p.logic_cells ? Row(*p.logic_cells) : Row(nullptr);
      row["lut_of_ii_1_pct"] = figure(area::percent(p.taken.luts, every_cycle.taken.luts), format);
    } else {
      row["area_mm2"] = figure(area::area_mm2(p.area_um2), format);
      row["area_per_box_mm2"] = figure(area::area_mm2(p.area_per_box_um2()), format);
      row["area_of_ii_1_pct"] =
          figure(area::percent(p.area_per_box_um2(), every_cycle.area_per_box_um2()), format);
      row["adp_mm2_ns"] = figure(area::adp_mm2_ns(p), format);
    }
    append_parts(row, p.lines, parts);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Area against rate.
void print_rates(const AreaOptions& options, const rtl::Library& library) {
  std::vector<RatedPrice> units;
  for (const ChosenUnit& unit : chosen(options)) {
    const auto price_at = [&](int interval) {
      return area::price(*unit.design, unit.format, library, options.account, options.flow_control, interval);
    };
    const Price every_cycle = price_at(1);
    for (const int interval : options.intervals)
      units.push_back({interval == 1 ? every_cycle : price_at(interval), every_cycle});
  }
  fmt::print("{}", options.format == OutputFormat::text
                       ? rates_text(units, library)
                       : table_text(rate_rows(units, library, options.format), options.format));
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
  if (!options.intervals.empty()) {
    print_rates(options, library);
    return;
  }
  const auto priced = [&](const rtl::Design& design, const rtl::Format& format) {
    return area::price(design, format, library, options.account, options.flow_control);
  };
  const std::vector<ChosenUnit> units = chosen(options);
  std::vector<Price> prices;
  for (const ChosenUnit& unit : units) prices.push_back(priced(*unit.design, unit.format));
  if (library.chip() != nullptr) {
    fmt::print("{}", chip_prices(prices, library, units, options));
    return;
  }
  if (options.by_stage) {
    fmt::print("{}", options.format == OutputFormat::text
                         ? by_stage_text(prices)
                         : table_text(stage_rows(prices, options.format), options.format));
    return;
  }
  std::optional<Price> baseline;
  if (area::can_price_baseline(library)) {
    const area::Entry& entry = area::baseline_design();
    baseline = priced(rtl::find_design(entry.design), entry.format);
  }
  fmt::print("{}", options.format == OutputFormat::text
                       ? area_text(prices, baseline)
                       : table_text(design_rows(prices, baseline, options.format), options.format));
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
