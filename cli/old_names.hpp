// Names of commands and options that others have taken the place of. They work for one release.
#pragma once

#include <string>
#include <vector>

namespace hitpipe::cli {

struct RenamedWords {
  std::vector<std::string> words;
  std::string notice;  ///< what to write today, one line; empty if the user wrote that
};

/// The words of a command line, without the program's.
[[nodiscard]] RenamedWords renamed(const std::vector<std::string>& words);

}  // namespace hitpipe::cli
