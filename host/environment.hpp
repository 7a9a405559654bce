// What the user says in environment variables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::host {

/// The variable's value, `otherwise` where it is not set or empty.
[[nodiscard]] std::string environment(const char* name, const std::string& otherwise);

/// The words of a text that blanks separate.
[[nodiscard]] std::vector<std::string> words_of(std::string_view text);

/// The program that the variable names and the arguments that follow, for example "env g++"; `otherwise`
/// where it names none. A value that is the path of a file is one word, whatever blanks it has.
[[nodiscard]] std::vector<std::string> program_of(const char* variable, const std::string& otherwise);

}  // namespace hitpipe::host
