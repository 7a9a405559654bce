#include "cli/options/design_options.hpp"

#include <CLI/CLI.hpp>

namespace hitpipe::cli {

void add_design_options(CLI::App& command, DesignChoice& choice) {
  command.add_option("design", choice.name, "A name that `hitpipe designs` lists")
      ->required()
      ->type_name("NAME");
  command
      .add_option("--bits", choice.bits,
                  "Number format of an integer design: n bits of a coordinate (6..32), t bits kept of a "
                  "product (6..2n-1); 20/24 unless given. Float designs have fp32 only")
      ->type_name("n/t");
}

}  // namespace hitpipe::cli
