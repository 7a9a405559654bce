// The programs that build a model: Verilator and a C++ compiler, of the user's choice.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/process.hpp"

namespace hitpipe::sim {

struct Tool {
  std::vector<std::string> words;  ///< the program, and arguments that come before all others
  std::string version;             ///< what it says of itself

  [[nodiscard]] std::string name() const;
  [[nodiscard]] host::Outcome run(const std::vector<std::string>& arguments,
                                  const std::filesystem::path& folder = {}) const;
  /// What it prints to standard output, without newlines at the end; nothing when it fails.
  [[nodiscard]] std::string answer(const std::vector<std::string>& arguments) const;
};

/// $variable, or `otherwise`. A program given by a path may be run from another folder later on. Throws
/// std::runtime_error, one line that names the package, when it does not tell its version.
[[nodiscard]] Tool find_tool(const char* variable, const std::string& otherwise, std::string_view package);

}  // namespace hitpipe::sim
