// `hitpipe implement --board`: a bitstream, and what the whole chip takes.
#pragma once

#include "cli/options/board_options.hpp"
#include "cli/text/table.hpp"
#include "sim/implement/unit_implementation.hpp"

namespace hitpipe::cli {

/// The board's usual unit when the choice names none. Returns the exit code.
[[nodiscard]] int implement_on_board(const DesignChoice& choice, const BoardChoice& board,
                                     const sim::ImplementOptions& options, Format format);

}  // namespace hitpipe::cli
