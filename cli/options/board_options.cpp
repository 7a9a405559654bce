#include "cli/options/board_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/values.hpp"

namespace hitpipe::cli {

DesignChoice BoardChoice::unit(const DesignChoice& choice) const {
  if (!choice.name.empty()) return choice;
  const rtl::Board here = board();
  return {here.design, choice.bits ? choice.bits : here.bits};
}

CLI::Option* add_board_option(CLI::App& command, BoardChoice& choice, const std::string& what) {
  return command
      .add_option("--board", choice.name, fmt::format("{} ({})", what, fmt::join(rtl::board_names(), ", ")))
      ->type_name("NAME");
}

CLI::Option* add_baud_option(CLI::App& command, BoardChoice& choice) {
  return add_count_option(command, "--baud", choice.baud, {1, 100'000'000},
                          "Bits a second on the serial line; without it the board's usual rate");
}

CLI::Option* add_port_option(CLI::App& command, std::string& port) {
  return command.add_option("--port", port, "The board's serial port, for example /dev/ttyUSB1")
      ->type_name("DEVICE");
}

CLI::Option* add_simulate_option(CLI::App& command, bool& simulate) {
  return command.add_flag("--simulate", simulate,
                          "Be the board: run its Verilog behind a pseudo-terminal and print the name of "
                          "that, until interrupted");
}

}  // namespace hitpipe::cli
