// Runs other programs as child processes without a shell, so every byte of an argument reaches the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hitpipe::host {

struct Outcome {
  int start_error = 0;  ///< errno if the program could not be started
  int signal = 0;       ///< the signal that ended the program, or 0
  int exit_code = 0;
  std::string out;  ///< what it wrote to standard output
  std::string err;  ///< what it wrote to standard error

  [[nodiscard]] bool not_found() const;
  [[nodiscard]] bool succeeded() const { return start_error == 0 && signal == 0 && exit_code == 0; }
  /// The outcome in words that follow the program's name, for example "failed with exit code 1".
  [[nodiscard]] std::string failure() const;
};

struct Surroundings {
  std::filesystem::path folder = {};  ///< the child's folder; empty: the current one
  std::string input = {};             ///< the whole of standard input
};

/// Runs a program to its end. `words` are its name and its arguments. A name without a slash is looked up in
/// $PATH. Throws std::runtime_error, one line, when the folder does not exist or the system has no pipes
/// left.
[[nodiscard]] Outcome run(const std::vector<std::string>& words, const Surroundings& surroundings = {});

}  // namespace hitpipe::host
