// The options by which a command chooses a board, the unit on it, and the rate of its serial line.
#pragma once

#include <optional>
#include <string>

#include "cli/options/design_options.hpp"
#include "rtl_gen/board/board.hpp"

namespace hitpipe::cli {

struct BoardChoice {
  std::string name;
  std::optional<int> baud;

  /// Throws what rtl::find_board() throws.
  [[nodiscard]] rtl::Board board() const { return rtl::find_board(name); }
  /// The board's usual unit, unless the user named one.
  [[nodiscard]] DesignChoice unit(const DesignChoice& choice) const;
};

/// --board; without it the choice keeps the name that it has.
CLI::Option* add_board_option(CLI::App& command, BoardChoice& choice, const std::string& what);
/// --baud.
CLI::Option* add_baud_option(CLI::App& command, BoardChoice& choice);
/// --port, of the board, and --simulate, which is the board.
CLI::Option* add_port_option(CLI::App& command, std::string& port);
CLI::Option* add_simulate_option(CLI::App& command, bool& simulate);

}  // namespace hitpipe::cli
