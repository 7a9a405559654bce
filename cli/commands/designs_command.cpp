#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/values.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

void add_designs_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command = program.add_subcommand("designs", "List the designs");
  const auto format = std::make_shared<Format>(Format::text);
  add_format_option(*command, *format);
  command->callback([format] {
    std::vector<Row> rows;
    for (const rtl::Design& design : rtl::designs()) {
      rows.push_back({{"design", design.name},
                      {"bits", rtl::to_string(design.default_format)},
                      {"may_miss", design.conservative ? "no" : "yes"},
                      {"what", design.summary}});
      if (*format == Format::text) continue;
      rows.back()["formats"] = design.default_format.family().allowed();
    }
    fmt::print("{}", table_text(rows, *format));
  });
}

}  // namespace hitpipe::cli
