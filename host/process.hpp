// Other programs, run as child processes without a shell: every byte of an argument reaches the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hitpipe::host {

struct Outcome {
  int start_error = 0;  ///< errno, when the program could not be started
  int signal = 0;       ///< that ended it
  int exit_code = 0;
  std::string out;  ///< what it wrote to standard output
  std::string err;  ///< what it wrote to standard error

  [[nodiscard]] bool not_found() const;
  [[nodiscard]] bool succeeded() const { return start_error == 0 && signal == 0 && exit_code == 0; }
  /// How it went, as words to follow the program's name, for example "failed with exit code 1".
  [[nodiscard]] std::string failure() const;
};

struct Surroundings {
  std::filesystem::path folder = {};  ///< to run in; empty: the present one
  std::string input = {};             ///< all that standard input holds
};

/// Runs a program, `words` being its name and its arguments, to its end. A name without a slash is looked up
/// in $PATH. Throws std::runtime_error, one line, when there is no such folder or the system lacks pipes.
[[nodiscard]] Outcome run(const std::vector<std::string>& words, const Surroundings& surroundings = {});

}  // namespace hitpipe::host
