// Options whose values are limited: whole numbers of a range, words of a list. Help and error message both
// say what is allowed.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::cli {

/// Takes decimal whole numbers from `least` to `most`, and nothing else: CLI::Range lets -1 through as the
/// largest number, reads 010 as 8, and describes itself in the help.
template <class Whole>
CLI::Validator whole_number(Whole least, Whole most) {
  const auto read = [least, most](std::string& text) {
    Whole value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end || value < least || value > most)
      return fmt::format("Value {} not in range {} to {}", text, least, most);
    text = fmt::format("{}", value);
    return std::string();
  };
  return {read, ""};
}

struct CountRange {
  int least;
  int most;
};

/// `value` is an int or a std::optional of it.
template <class Count>
CLI::Option* add_count_option(CLI::App& command, const std::string& name, Count& value, CountRange allowed,
                              const std::string& what) {
  return command.add_option(name, value, fmt::format("{} ({} to {})", what, allowed.least, allowed.most))
      ->transform(whole_number(allowed.least, allowed.most))
      ->type_name("N");
}

/// The same for numbers that an int may not hold. `what` says in words what is allowed.
inline CLI::Option* add_large_count_option(CLI::App& command, const std::string& name, std::uint64_t& value,
                                           std::uint64_t least, std::uint64_t most, const std::string& what) {
  return command.add_option(name, value, what)
      ->transform(whole_number(least, most))
      ->type_name("N")
      ->capture_default_str();
}

/// --seed, of whatever a command draws.
inline CLI::Option* add_seed_option(CLI::App& command, std::uint64_t& value) {
  return add_large_count_option(command, "--seed", value, 0, std::numeric_limits<std::uint64_t>::max(),
                                "Of the cases; the same seed gives the same cases (0 to 2^64 - 1)");
}

/// Several values of one option. In a command without arguments of its own they may be separated by commas,
/// by blanks, or by the option's name again; else blanks would take the argument for a value.
template <class Value>
CLI::Option* add_list_option(CLI::App& command, const std::string& name, std::vector<Value>& values,
                             const std::string& what, const std::string& type) {
  const bool has_arguments =
      !command.get_options([](const CLI::Option* o) { return o->get_positional(); }).empty();
  return command.add_option(name, values, what)
      ->delimiter(',')
      ->allow_extra_args(!has_arguments)
      ->type_name(type);
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
