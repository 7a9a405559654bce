// The programs that build a model: Verilator and a C++ compiler, as the user chooses.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/process.hpp"

namespace hitpipe::sim {

struct Tool {
  std::vector<std::string> words;  ///< the program, then arguments that always come first
  std::string version;             ///< what its --version prints

  [[nodiscard]] std::string name() const;
  [[nodiscard]] host::Outcome run(const std::vector<std::string>& arguments,
                                  const std::filesystem::path& folder = {}) const;
  /// What it prints to standard output, without the newlines at the end. Nothing when it fails.
  [[nodiscard]] std::string answer(const std::vector<std::string>& arguments) const;
};

/// Takes $variable, or `otherwise` if that is not set. A program given by a path can also be run from another
/// folder. Throws std::runtime_error, one line that names the package, when the program does not print its
/// version.
[[nodiscard]] Tool find_tool(const char* variable, const std::string& otherwise, std::string_view package);

}  // namespace hitpipe::sim
