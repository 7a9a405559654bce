// Other programs that this one runs: Verilator and a C++ compiler, of the user's choice.
#pragma once

#include <string>
#include <string_view>

namespace hitpipe::sim {

/// One word for the shell, whatever characters it has.
[[nodiscard]] std::string shell_word(const std::string& word);

/// Runs a shell command; its exit code, -1 when it was killed.
[[nodiscard]] int run(const std::string& command);

/// What a shell command prints, without newlines at the end; nothing when it fails.
[[nodiscard]] std::string output_of(const std::string& command);

/// The variable's value, `otherwise` where it is not set or empty.
[[nodiscard]] std::string environment(const char* name, const std::string& otherwise);

/// A program and what it says of itself.
struct Tool {
  std::string program;
  std::string version;
};

/// $variable, or `otherwise`. A program given by a path may be run from another folder later on. Throws
/// std::runtime_error, one line that names the package, when it does not tell its version.
[[nodiscard]] Tool find_tool(const char* variable, const std::string& otherwise, std::string_view package);

}  // namespace hitpipe::sim
