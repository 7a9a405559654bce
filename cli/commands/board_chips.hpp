// What `implement` does with a board: a bitstream of a unit or a core, and what the whole chip takes.
#pragma once

#include "cli/options/board_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/implement/unit_implementation.hpp"

namespace hitpipe::cli {

/// The board's usual unit when the choice names none. Returns the exit code. Throws as sim::implement_board()
/// does.
int implement_on_board(const DesignChoice& choice, const BoardChoice& board,
                       const sim::ImplementOptions& options, OutputFormat format);

/// The board's usual core, in the format that the user wrote. Throws std::runtime_error, one line, when the
/// board has none, or there is no such format.
[[nodiscard]] rtl::CoreOptions core_on_board(const rtl::Board& board, const std::optional<std::string>& bits);

/// A core. Returns the exit code. Throws as core_on_board() and sim::implement_core_board() do.
int implement_core_on_board(const std::optional<std::string>& bits, const BoardChoice& board,
                            const sim::ImplementOptions& options, OutputFormat format);

}  // namespace hitpipe::cli
