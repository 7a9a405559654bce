// What `board` does with a core in place of a unit.
#pragma once

#include <optional>
#include <string>

#include "cli/options/board_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/text/table.hpp"

namespace hitpipe::cli {

struct BoardCore {
  std::optional<std::string> bits;  ///< without: those of the board's usual core
  BoardChoice board;
  std::string port{};
  SceneChoice scene{};
  ref::HierarchyOptions hierarchy{};
  std::string out{};  ///< empty: no picture is written
  OutputFormat format = OutputFormat::text;
};

/// Writes the scene's image to the board, sends the rays of its picture, and compares each answer with
/// software. Returns the exit code. Throws as core_on_board() and sim::CoreLink do.
int trace_by_board(const BoardCore& core);

/// Is the board, until interrupted.
int simulate_core(const BoardCore& core);

}  // namespace hitpipe::cli
