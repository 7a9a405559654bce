#include "cli/options/implement_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/values.hpp"
#include "rtl_gen/component/library.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::cli {

CLI::Option* add_target_option(CLI::App& command, std::string& target) {
  return as_input(
             command.add_option("--target", target,
                                fmt::format("A built-in target ({}) or a file NAME.json; a board has its own",
                                            fmt::join(sim::target_names(), ", "))))
      ->type_name("NAME|FILE");
}

void add_implement_options(CLI::App& command, sim::ImplementOptions& options) {
  command
      .add_option_function<std::string>(
          "--out", [&options](const std::string& folder) { options.folder = folder; },
          "Folder; the Verilog and the tools' files go to a folder in it that is named after the target")
      ->check(is_folder)
      ->type_name("FOLDER")
      ->required();
  as_input(command.add_option(
               "--library", options.library,
               fmt::format("Component library that drives the schedule, a built-in one ({}) or a file "
                           "NAME.json. Default: the target's",
                           fmt::join(rtl::built_in_names(), ", "))))
      ->type_name("NAME|FILE");
  command.add_option("--name", options.module, "Name of the Verilog module. Default: as `rtl` names it")
      ->type_name("MODULE");
}

CLI::Option* add_seeds_option(CLI::App& command, int& seeds, const std::string& more) {
  return add_count_option(
             command, "--seeds", seeds, {0, 100},
             "Place with seeds 1 to N; prints the clock of the median and of the best seed" + more)
      ->capture_default_str();
}

}  // namespace hitpipe::cli
