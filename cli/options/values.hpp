// Options whose values are limited: whole numbers of a range, words of a list. Help and error message both
// say what is allowed.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::cli {

struct CountRange {
  int least;
  int most;
};

/// `value` is an int or a std::optional of it.
template <class Count>
CLI::Option* add_count_option(CLI::App& command, const std::string& name, Count& value, CountRange allowed,
                              const std::string& what) {
  return command.add_option(name, value, fmt::format("{} ({} to {})", what, allowed.least, allowed.most))
      ->check(CLI::Range(allowed.least, allowed.most).description(""))
      ->type_name("N");
}

/// A folder to write to, not empty.
inline CLI::Option* add_folder_option(CLI::App& command, std::string& value, const std::string& what) {
  const auto named = [](const std::string& folder) {
    return folder.empty() ? "is empty; give the name of a folder" : std::string();
  };
  return command.add_option("--out", value, what)->check(named)->type_name("FOLDER");
}

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// `value` keeps what it holds, which must be among the choices, unless the option is given.
template <class Value>
CLI::Option* add_choice_option(CLI::App& command, const std::string& name, Value& value,
                               const Choices<Value>& choices, const std::string& what) {
  std::vector<std::string> words;
  std::string present;
  for (const auto& [word, meaning] : choices) {
    words.push_back(word);
    if (meaning == value) present = word;
  }
  const auto choose = [name, words, choices, &value](const std::string& given) {
    for (const auto& [word, meaning] : choices) {
      if (word == given) {
        value = meaning;
        return;
      }
    }
    throw CLI::ValidationError(name, fmt::format("{} is none of {}", given, fmt::join(words, ", ")));
  };
  return command.add_option_function<std::string>(name, choose, what)
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->default_str(present);
}

}  // namespace hitpipe::cli
