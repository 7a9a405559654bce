#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/options/core_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "rtl_gen/core/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/core/core_vectors.hpp"
#include "sim/vectors/design_vectors.hpp"

namespace hitpipe::cli {

namespace {

struct CoreRtlCommand {
  CoreChoice core;
  std::string out;
  std::string library{rtl::default_library};
  std::string module;  ///< empty: that of the core's options
  int cycles = sim::usual_core_cycles;
  std::uint64_t seed = sim::usual_seed;
  OutputFormat format = OutputFormat::text;
};

void emit_core(const CoreRtlCommand& command) {
  if (!command.module.empty()) rtl::check_module_name(command.module);
  const rtl::Library library = rtl::library_called(command.library);
  const rtl::Core core = rtl::make_core(command.core.core(), library, command.module);
  std::vector<host::File> files =
      rtl::core_files(core, library, sim::core_test(core, command.cycles, command.seed));
  rtl::add_drawings(files);
  host::write_files(command.out, files);
  std::vector<std::string> names;
  for (const host::File& file : files)
    names.push_back((std::filesystem::path(command.out) / file.name).string());
  std::vector<std::string> features;
  for (const rtl::Feature* const feature : rtl::features_of(core.options))
    features.emplace_back(feature->name);
  Row row{{"core", core.module},
          {"bits", to_string(Format(core.options.bits))},
          {"rays", core.options.rays},
          {"features", fmt::format("{}", fmt::join(features, ", "))}};
  for (const rtl::Part& part : core.parts)
    if (part.pipeline) row[fmt::format("{}_latency", part.name)] = part.pipeline->latency();
  row.update(Row{{"clock_ps", core.clock_ps},
                 {"library", library.name()},
                 {"cycles", command.cycles},
                 {"files", names}});
  fmt::print("{}", record_text(row, command.format));
}

}  // namespace

CLI::App* add_core_rtl_command(CLI::App& core, int& /*exit_code*/) {
  CLI::App* const command =
      core.add_subcommand("rtl", "Write a core's Verilog, bus wrapper, C header, picture and testbench");
  const auto options = std::make_shared<CoreRtlCommand>();
  add_core_bits_option(*command, options->core.bits, to_string(Format(options->core.options.bits)));
  add_folder_option(*command, options->out, "Folder to write to; made if it is not there")->required();
  using Group = rtl::CoreOption::Group;
  add_core_options(*command, options->core,
                   {Group::rays, Group::core, Group::cache, Group::ports, Group::limits, Group::bus});
  add_library_option(*command, options->library);
  add_count_option(*command, "--clock-ps", options->core.options.clock_ps, {1, 1'000'000'000},
                   "Clock period in picoseconds; by default what the slowest component needs, on iCE40 up to "
                   "a quarter more");
  command
      ->add_option("--name", options->module,
                   "Name of the Verilog module, which also begins the names of all files")
      ->type_name("MODULE");
  add_count_option(*command, "--cycles", options->cycles, {1, 10'000'000}, "Cycles of the testbench")
      ->capture_default_str();
  add_seed_option(*command, options->seed);
  add_format_option(*command, options->format);
  add_examples(*command,
               {"hitpipe core rtl --out core", "hitpipe core rtl --rays 128 --door float --out core"});
  command->callback([options] { emit_core(*options); });
  return command;
}

}  // namespace hitpipe::cli
