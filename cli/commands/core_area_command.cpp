#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/core_price.hpp"
#include "area_model/figure.hpp"
#include "cli/commands.hpp"
#include "cli/options/core_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/core/axi.hpp"

namespace hitpipe::cli {

namespace {

struct CoreAreaCommand {
  CoreChoice core;
  std::string library{rtl::default_library};
  OutputFormat format = OutputFormat::text;
};

/// What each part of the core takes, and all of them, and then what stands around it. Bits of memories are apart.
void print_price(const CoreAreaCommand& command) {
  const rtl::Library library = rtl::library_called(command.library);
  const rtl::Core core = rtl::make_core(command.core.core(), library);
  const area::CorePrice price = area::price(core, library);
  std::vector<Row> rows;
  const auto add = [&](std::string_view part, const Format& bits, const area::CorePartPrice& of) {
    Row row{{"part", part}, {"bits", to_string(bits)}, {"memory_bits", of.memory_bits}};
    if (library.chip() == nullptr) {
      const std::string digits = area::area_mm2(of.area_um2);
      row["area_mm2"] = command.format == OutputFormat::json ? Row::parse(digits) : Row(digits);
    } else {
      row["lut"] = of.taken.luts;
      row["ff"] = of.taken.registers;
      row["dsp"] = of.taken.blocks;
    }
    rows.push_back(row);
  };
  for (std::size_t i = 0; i < core.parts.size(); ++i)
    add(core.parts[i].name, core.parts[i].format, price.parts[i]);
  add("core", core.options.bits, price.all);
  std::vector<rtl::Part> around = rtl::behind_axi(core).parts;
  std::erase_if(around, [](const rtl::Part& part) { return part.machine == nullptr; });
  const area::CorePrice of_bus = area::price(around, library);
  for (std::size_t i = 0; i < around.size(); ++i) add(around[i].name, around[i].format, of_bus.parts[i]);
  add("core_axi", core.options.bits, price.all + of_bus.all);
  fmt::print("{}", table_text(rows, command.format));
}

}  // namespace

CLI::App* add_core_area_command(CLI::App& core, int& /*exit_code*/) {
  CLI::App* const command = core.add_subcommand("area", "Price a core and each of its parts");
  const auto options = std::make_shared<CoreAreaCommand>();
  add_core_bits_option(*command, options->core.bits, to_string(Format(options->core.options.bits)));
  using Group = rtl::CoreOption::Group;
  add_core_options(*command, options->core, {Group::rays, Group::core, Group::cache, Group::limits});
  add_library_option(*command, options->library);
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe core area", "hitpipe core area --library xc7 --triangle-ii serial"});
  command->callback([options] { print_price(*options); });
  return command;
}

}  // namespace hitpipe::cli
