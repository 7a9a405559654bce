// Programs that are not hitpipe's and do a part of its work, as the user chooses them.
#pragma once

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host/process.hpp"

namespace hitpipe::sim {

struct Tool {
  std::vector<std::string> words;  ///< the program, then arguments that always come first
  std::string version;             ///< what it prints when it is asked for its version

  [[nodiscard]] std::string name() const;
  [[nodiscard]] host::Outcome run(const std::vector<std::string>& arguments,
                                  const std::filesystem::path& folder = {},
                                  std::chrono::milliseconds time_limit = host::working_time) const;
  /// What it prints to standard output, without the newlines at the end. Nothing when it fails.
  [[nodiscard]] std::string answer(const std::vector<std::string>& arguments) const;
  /// The first line of its version.
  [[nodiscard]] std::string release() const { return version.substr(0, version.find('\n')); }
};

/// One line: the program cannot be run, why, unless that is empty, and that the package that has it, unless
/// that is empty, or the variable would help.
[[nodiscard]] std::runtime_error cannot_be_run(const Tool& tool, std::string_view package,
                                               const std::string& variable, const std::string& why = "");

/// Takes $variable, or `otherwise` if that is not set. A program given by a path can also be run from another
/// folder. Its version may also be on standard error. Throws cannot_be_run() when the program does not print
/// its version.
[[nodiscard]] Tool find_tool(const char* variable, const std::string& otherwise, std::string_view package,
                             const std::string& version_option = "--version");

}  // namespace hitpipe::sim
