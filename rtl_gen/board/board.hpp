// A circuit board on which a unit or a core can run: its chip, its clock and its pins. Each file
// boards/NAME.json is compiled in under the name NAME; there is no list of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

struct BoardFile {
  std::string_view name;
  std::string_view json;
};
/// In the order of their names. The build writes this function.
[[nodiscard]] std::span<const BoardFile> board_files();

/// A pin of the package, and the port of the top module that it carries (rtl_gen/board/top.hpp).
struct BoardPin {
  std::string port;
  std::string pin;
};

struct Board {
  std::string name;
  std::string description;  ///< the board and its chip, for people
  std::string source;       ///< where the pins come from
  std::string target;       ///< of `hitpipe implement`
  std::string design;       ///< the usual unit on it
  std::string bits;         ///< of that unit
  int clock_hz = 0;
  int baud = 0;  ///< of the serial line, unless the user chooses another
  std::vector<BoardPin> pins;
  /// The usual core on it, whose image a memory of the chip has room for; of a chip without one nothing.
  std::optional<CoreOptions> core;

  /// The clock period for which units are scheduled here, in ps: three quarters of the board's. A unit may be
  /// a quarter slower than its component library says. A shorter period would only cost registers.
  [[nodiscard]] int unit_clock_ps() const;
  /// Clock cycles for a bit of the serial line. Throws std::runtime_error, one line, when the clock does not
  /// give that rate within 2 %, or has fewer than 4 cycles a bit.
  [[nodiscard]] int clocks_per_bit(int baud_rate) const;
};

[[nodiscard]] std::vector<std::string> board_names();
/// Throws std::runtime_error, one line that says which boards there are.
[[nodiscard]] Board find_board(std::string_view name);
/// Throws std::runtime_error, one line, when the text is no board.
[[nodiscard]] Board parse_board(const BoardFile& file);

}  // namespace hitpipe::rtl
