#include "cli/options/library_option.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/component/library.hpp"

namespace hitpipe::cli {

void add_library_option(CLI::App& command, std::string& library) {
  command
      .add_option("--library", library,
                  fmt::format("Component library, a built-in one ({}) or a file NAME.json",
                              fmt::join(rtl::built_in_names(), ", ")))
      ->type_name("NAME|FILE")
      ->capture_default_str();
}

}  // namespace hitpipe::cli
