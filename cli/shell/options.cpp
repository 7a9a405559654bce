#include "cli/shell/options.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands/machines.hpp"
#include "cli/text/help.hpp"
#include "rtl_gen/board/board.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "sim/core/memory_port.hpp"
#include "sim/implement/target.hpp"
#include "sw_ref/scene/built_in.hpp"

namespace hitpipe::cli {

namespace {

/// Of what has names, such as the designs.
template <class List>
std::vector<std::string> names_in(const List& list) {
  std::vector<std::string> names;
  for (const auto& each : list) names.emplace_back(each.name);
  return names;
}

std::vector<std::string> built_in_names_of(const CLI::Option& option) {
  if (option.get_type_name() != "NAME" && option.get_type_name() != "NAME|FILE") return {};
  const std::string name = option.get_name();
  if (name == "--scene") return names_in(ref::built_in_scenes());
  if (name == "--library") return rtl::built_in_names();
  if (name == "--memory") return names_in(sim::known_memories());
  if (name == "--target") return sim::target_names();
  if (name == "--board") return rtl::board_names();
  if (name == "--image-design" || name == "--box-unit") return names_in(rtl::designs());
  return {};
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  std::vector<const CLI::App*> all{&program};
  for (const CLI::App* const command : program.get_subcommands({})) {
    const std::vector<const CLI::App*> below = commands_of(*command);
    all.insert(all.end(), below.begin(), below.end());
  }
  return all;
}

std::string words_of(const CLI::App& command) {
  const std::string name = full_name(command);
  const std::size_t blank = name.find(' ');
  return blank == std::string::npos ? "" : name.substr(blank + 1);
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back(fmt::format("-{}", name));
  for (const std::string& name : option.get_lnames()) names.push_back(fmt::format("--{}", name));
  return names;
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  std::vector<std::string> words;
  std::istringstream text(option.get_type_name());
  for (std::string word; std::getline(text, word, '|');) words.push_back(word);
  const auto stands_for_itself = [](const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
      return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_' || c == '-' || c == '.';
    });
  };
  const bool choice = words.size() > 1 && std::all_of(words.begin(), words.end(), stands_for_itself);
  return choice ? words : built_in_names_of(option);
}

bool takes_file(const CLI::Option& option) {
  return option.get_type_name().ends_with("FILE");
}

std::vector<Completion> completions_of(const CLI::App& program) {
  std::vector<Completion> all;
  for (const CLI::App* const command : commands_of(program)) {
    Completion one{words_of(*command), {}, {}, {}};
    for (const CLI::App* const below : command->get_subcommands({})) one.commands.push_back(below);
    for (const CLI::Option* const option : options_of(*command)) {
      if (!option->get_positional())
        one.options.push_back(option);
      else if (option->get_type_name().starts_with("NAME"))
        one.units = names_in(rtl::designs());
      else if (option->get_type_name() == "COMMAND")
        for (const CLI::App* const each : program.get_subcommands({})) one.commands.push_back(each);
    }
    if (takes_machines(*command))
      for (const std::string& machine : names_in(rtl::machines())) one.units.push_back(machine);
    all.push_back(one);
  }
  return all;
}

std::string command_pattern(const CLI::App& program) {
  std::vector<std::string> patterns;
  for (const CLI::App* const command : commands_of(program))
    if (command != &program)
      patterns.push_back(fmt::format("'{} {}'", words_of(*command->get_parent()), command->get_name()));
  return fmt::format("{}", fmt::join(patterns, "|"));
}

}  // namespace hitpipe::cli
