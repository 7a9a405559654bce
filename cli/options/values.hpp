// Options with limited values: whole numbers in a range, words from a list. Both help and error message say
// what is allowed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/text/table.hpp"
#include "host/outputs.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

/// Accepts only decimal numbers of this type from `least` to `most`. CLI::Range would accept NaN, take -1 for
/// the largest whole number, read 010 as 8, and print its own description in the help.
template <class Number>
CLI::Validator number_from(Number least, Number most) {
  const auto read = [least, most](std::string& text) {
    const auto value = host::number_in<Number>(text);
    if (!value || !(*value >= least && *value <= most))
      return fmt::format("Value {} not in range {} to {}", host::shortened(text), least, most);
    text = fmt::format("{}", *value);
    return std::string();
  };
  return {read, ""};
}

struct CountRange {
  int least;
  int most;
};

/// `value` is an int or a std::optional of int.
template <class Count>
CLI::Option* add_count_option(CLI::App& command, const std::string& name, Count& value, CountRange allowed,
                              const std::string& what) {
  return command.add_option(name, value, fmt::format("{} ({} to {})", what, allowed.least, allowed.most))
      ->transform(number_from(allowed.least, allowed.most))
      ->type_name("N");
}

/// The same for numbers that may not fit an int. `what` says in words what is allowed.
inline CLI::Option* add_large_count_option(CLI::App& command, const std::string& name, std::uint64_t& value,
                                           std::uint64_t least, std::uint64_t most, const std::string& what) {
  return command.add_option(name, value, what)
      ->transform(number_from(least, most))
      ->type_name("N")
      ->capture_default_str();
}

/// --seed, for everything that a command draws at random.
inline CLI::Option* add_seed_option(CLI::App& command, std::uint64_t& value) {
  return add_large_count_option(
      command, "--seed", value, 0, std::numeric_limits<std::uint64_t>::max(),
      "Seed of the random cases; the same seed gives the same cases (0 to 2^64 - 1)");
}

/// Several values of one option, separated by commas. A command without arguments of its own also takes
/// blanks between them. In other commands the argument would be taken for a value.
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

/// The check of a folder to write to. The name must not be empty.
inline std::string is_folder(const std::string& folder) {
  if (folder.empty()) return "is empty; give the name of a folder";
  host::announce_output_folder(folder);
  return "";
}

/// --out, a folder to write to.
inline CLI::Option* add_folder_option(CLI::App& command, std::string& value, const std::string& what) {
  return command.add_option("--out", value, what)->check(is_folder)->type_name("FOLDER");
}

/// A file that the command reads. No file that it writes takes its place.
inline CLI::Option* as_input(CLI::Option* option) {
  return option->check([](const std::string& file) {
    host::never_replace(file);
    return std::string();
  });
}

/// A file that the command writes. Whether it can is known before the command begins.
inline CLI::Option* as_output(CLI::Option* option) {
  return option->type_name("FILE")->check([option](const std::string& file) -> std::string {
    if (file.empty()) return "is empty; give the name of a file";
    host::announce_output(option->get_name(), file);
    return "";
  });
}

/// Refuses the one option beside the other: "--unit excludes --bits: WHY".
inline void exclude(CLI::Option* option, const CLI::Option* other, const std::string& why) {
  option->check([option, other, why](const std::string&) {
    if (other->count() > 0)
      throw CLI::ParseError(fmt::format("{} excludes {}: {}", option->get_name(), other->get_name(), why),
                            CLI::ExitCodes::ExcludesError);
    return std::string();
  });
}

/// Refuses `option` together with any option of the command that is not in `allowed`.
inline void exclude_all_but(CLI::App& command, CLI::Option* option, const std::vector<std::string>& allowed,
                            const std::string& why) {
  for (const CLI::Option* const other : command.get_options())
    if (other != option && other != command.get_help_ptr() &&
        std::find(allowed.begin(), allowed.end(), other->get_name()) == allowed.end())
      exclude(option, other, why);
}

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// Without the option, `value` keeps what it holds, which must be one of the choices.
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
    throw CLI::ValidationError(
        name, fmt::format("{} is none of {}", host::shortened(given), fmt::join(words, ", ")));
  };
  return command.add_option_function<std::string>(name, choose, what)
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->default_str(present);
}

/// --format, for what a command prints.
inline void add_format_option(CLI::App& command, OutputFormat& format) {
  add_choice_option<OutputFormat>(
      command, "--format", format,
      {{"text", OutputFormat::text}, {"csv", OutputFormat::csv}, {"json", OutputFormat::json}},
      "How to print: text, csv or json");
}

}  // namespace hitpipe::cli
