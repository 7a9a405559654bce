#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/values.hpp"
#include "cli/text/table.hpp"
#include "sw_ref/scene/built_in.hpp"

namespace hitpipe::cli {

void add_scenes_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command = program.add_subcommand("scenes", "List the built-in scenes");
  const auto format = std::make_shared<Format>(Format::text);
  add_format_option(*command, *format);
  command->callback([format] {
    std::vector<Row> rows;
    for (const ref::BuiltInScene& scene : ref::built_in_scenes()) {
      Row& row = rows.emplace_back(Row{{"scene", scene.name}, {"triangles", scene.triangles}});
      if (*format != Format::text) {  // lines of text are short
        row["least"] = scene.least;
        row["most"] = scene.most;
        row["lights"] = scene.lights;
      }
      row["stands_for"] = scene.stands_for;
      row["what"] = scene.what;
    }
    fmt::print("{}", table_text(rows, *format));
  });
}

}  // namespace hitpipe::cli
