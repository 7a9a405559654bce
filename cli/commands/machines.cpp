#include "cli/commands/machines.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "area_model/price.hpp"
#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/emit/machine_files.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::cli {

namespace {

/// The heading in the help.
constexpr const char* units_only = "Options of a unit";

Format format_of(const rtl::Machine& machine, const std::optional<std::string>& bits) {
  return bits ? machine.parse_format(*bits) : machine.default_format;
}

Row machine_row(const rtl::Machine& machine, const Format& format, const rtl::Library& library,
                OutputFormat output) {
  const area::MachinePrice price = area::price(machine.graph(format), library);
  Row row{{"machine", machine.name},
          {"bits", to_string(format)},
          {"library", library.name()},
          {"clock_ps", price.clock_ps},
          {"register_bits", price.register_bits},
          {"memory_bits", price.memory_bits}};
  if (library.chip() == nullptr) {
    const std::string digits = area::area_mm2(price.area_um2);
    row["area_mm2"] = output == OutputFormat::json ? Row::parse(digits) : Row(digits);
  } else {
    row["lut"] = price.taken.luts;
    row["ff"] = price.taken.registers;
  }
  return row;
}

}  // namespace

void emit_machine(const rtl::Machine& machine, const std::optional<std::string>& bits,
                  const MachineRtl& options) {
  if (!options.module.empty()) rtl::check_module_name(options.module);
  const Format format = format_of(machine, bits);
  const rtl::Library library = rtl::library_called(options.library);
  std::vector<host::File> files = rtl::machine_files(
      machine, format, library, {.module = options.module, .cycles = options.cycles, .seed = options.seed});
  rtl::add_drawings(files);
  host::write_files(options.out, files);
  Row row = machine_row(machine, format, library, options.format);
  row["cycles"] = options.cycles;
  std::vector<std::string> names;
  for (const host::File& file : files)
    names.push_back((std::filesystem::path(options.out) / file.name).string());
  row["files"] = names;
  fmt::print("{}", record_text(row, options.format));
}

void print_machine_prices(const std::vector<const rtl::Machine*>& machines,
                          const std::optional<std::string>& bits, const std::string& library,
                          OutputFormat format) {
  const rtl::Library priced = rtl::library_called(library);
  std::vector<Row> rows;
  for (const rtl::Machine* const machine : machines)
    rows.push_back(machine_row(*machine, format_of(*machine, bits), priced, format));
  fmt::print("{}", table_text(rows, format));
}

std::string machines_text(OutputFormat format) {
  std::vector<Row> rows;
  for (const rtl::Machine& machine : rtl::machines()) {
    rows.push_back(
        {{"machine", machine.name}, {"bits", to_string(machine.default_format)}, {"what", machine.summary}});
    if (format != OutputFormat::text) rows.back()["formats"] = machine.default_format.family().allowed();
  }
  return table_text(rows, format);
}

void of_units(CLI::App& command, const std::vector<std::string>& names) {
  for (const std::string& name : names) command.get_option(name)->group(units_only);
  const auto tell = [&](const char* name, const std::string& before, const std::string& more) {
    CLI::Option* const option = command.get_option(name);
    std::string text = option->get_description();
    option->description(text.insert(text.find(before) + before.size(), more));
  };
  tell("design", "`hitpipe list designs`", " or `hitpipe list machines`");
  const std::string bits = command.get_option("--bits")->get_description();
  tell("--bits", bits, ". Formats of machines: `hitpipe list machines --format json`");
}

bool takes_machines(const CLI::App& command) {
  const std::vector<const CLI::Option*> options = command.get_options();
  return std::any_of(options.begin(), options.end(),
                     [](const CLI::Option* option) { return option->get_group() == units_only; });
}

void refuse_of_units(const CLI::App& command, const rtl::Machine& machine) {
  for (const CLI::Option* const option : command.get_options())
    if (option->count() > 0 && option->get_group() == units_only)
      throw std::runtime_error(
          fmt::format("{}: {} is a machine; only a unit has this option", option->get_name(), machine.name));
}

}  // namespace hitpipe::cli
