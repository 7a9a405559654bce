// A unit or a core as the whole of a chip on a board: synthesised with its top module, placed on the board's
// pins, and packed as a bitstream.
#pragma once

#include <filesystem>
#include <optional>

#include "rtl_gen/board/board.hpp"
#include "sim/implement/unit_implementation.hpp"

namespace hitpipe::sim {

struct BoardImplementation {
  /// Of the whole chip. `module` is the top; there is no netlist simulation.
  Implementation chip;
  /// Nothing when the chip does not fit, or is slower than the board's clock.
  std::optional<std::filesystem::path> bitstream;
};

/// Writes the unit and the files of the tools as implement_unit() does, with the top module and the bitstream
/// beside them. Of the seeds the fastest is packed. Throws as implement_unit() and
/// rtl::Board::clocks_per_bit() do, and std::runtime_error, one line, when the target is not placed. The
/// options of the netlist simulation are not used.
[[nodiscard]] BoardImplementation implement_board(const rtl::Design& design, const Format& format,
                                                  const rtl::Board& board, int baud,
                                                  const ImplementOptions& options);

/// Likewise a core with its image's memory (rtl_gen/board/core_top.hpp). Throws as rtl::make_core() too.
[[nodiscard]] BoardImplementation implement_core_board(const rtl::CoreOptions& core_options,
                                                       const rtl::Board& board, int baud,
                                                       const ImplementOptions& options);

}  // namespace hitpipe::sim
