// What the user sets in environment variables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::host {

/// The variable's value. `otherwise` if it is not set or empty.
[[nodiscard]] std::string environment(const char* name, const std::string& otherwise);

/// The words of a text, separated by blanks.
[[nodiscard]] std::vector<std::string> words_of(std::string_view text);

/// The program that the variable names and the arguments after it, for example "env g++". `otherwise` if it
/// names none. A value that is the path of a file is one word, even with blanks.
[[nodiscard]] std::vector<std::string> program_of(const char* variable, const std::string& otherwise);

}  // namespace hitpipe::host
