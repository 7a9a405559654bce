// Runs the program hitpipe as a process of its own and keeps what it printed.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::cli {

struct Outcome {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out;
  std::string err;
};

/// Variables to set for the program alone.
using Variables = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] Outcome run_hitpipe(const std::vector<std::string>& arguments, const Variables& variables = {});

/// The lines of a text; the last must have ended.
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

/// The characters of the widest line, each of UTF-8 counted once.
[[nodiscard]] std::size_t widest_line(const std::string& text);

/// All files below a folder, by their paths in it, sorted.
[[nodiscard]] std::vector<std::string> files_below(const std::filesystem::path& folder);

[[nodiscard]] std::string contents_of(const std::filesystem::path& file);

}  // namespace hitpipe::cli
