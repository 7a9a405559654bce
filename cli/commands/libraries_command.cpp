#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/component/built_in.hpp"

namespace hitpipe::cli {

void add_libraries_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command = program.add_subcommand("libraries", "List the component libraries");
  const auto format = std::make_shared<Format>(Format::text);
  add_format_option(*command, *format);
  command->callback([format] {
    std::vector<Row> rows;
    for (const std::string& name : rtl::built_in_names()) {
      const rtl::Library library = rtl::library_called(name);
      rows.push_back({{"library", name}, {"source", library.source()}});
    }
    fmt::print("{}", table_text(rows, *format));
  });
}

}  // namespace hitpipe::cli
