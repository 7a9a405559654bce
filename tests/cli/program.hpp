// Runs the program hitpipe as a process and keeps what it printed.
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

/// Variables to set only for the program.
using Variables = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] Outcome run_hitpipe(const std::vector<std::string>& arguments, const Variables& variables = {});

/// The same with words that blanks separate.
[[nodiscard]] Outcome hitpipe(const std::string& words, const Variables& variables = {});

/// Both, as the arguments of one run.
[[nodiscard]] std::vector<std::string> with(std::vector<std::string> arguments,
                                            const std::vector<std::string>& more);

/// What it prints. It must end well and be silent on standard error.
std::string printed(const std::string& words);

/// A program to run as Verilator, for the variable VERILATOR: the model of an integer design never hits.
[[nodiscard]] std::string always_missing_verilator(const sim::TemporaryFolder& folder);
/// The same for a model of Verilog that sed has changed.
[[nodiscard]] std::string damaging_verilator(const sim::TemporaryFolder& folder, const std::string& sed);

/// The lines of a text. The last one must have a line end.
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

/// The number of characters in the widest line; each UTF-8 character counts once.
[[nodiscard]] std::size_t widest_line(const std::string& text);

/// All files below a folder, by their paths in it, sorted.
[[nodiscard]] std::vector<std::string> files_below(const std::filesystem::path& folder);

[[nodiscard]] std::string contents_of(const std::filesystem::path& file);

}  // namespace hitpipe::cli
