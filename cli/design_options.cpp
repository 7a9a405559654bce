#include "cli/design_options.hpp"

#include <CLI/CLI.hpp>

namespace hitpipe::cli {

void add_design_options(CLI::App& command, DesignChoice& choice) {
  command.add_option("design", choice.name, "A name that `hitpipe designs` lists")
      ->required()
      ->type_name("NAME");
  command
      .add_option("--bits", choice.format,
                  "Number format: n bits of a coordinate (6..32), t bits kept of a distance (6..2n-1)")
      ->type_name("n/t")
      ->capture_default_str();
}

}  // namespace hitpipe::cli
