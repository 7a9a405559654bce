#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/shell/options.hpp"
#include "cli/version.hpp"

namespace hitpipe::cli {

namespace {

std::string quoted(const std::string& text) {
  std::string kept = "'";
  for (const char c : text)
    if (c == '\'')
      kept += "'\\''";
    else
      kept += c;
  kept += "'";
  return kept;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

/// Calls `write` with the pattern 'core rtl --format'|... of each option that takes a value, and the option.
template <class Write>
void for_each_value(const Completion& one, const Write& write) {
  for (const CLI::Option* const option : one.options) {
    if (option->get_items_expected_max() == 0) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : names_of(*option))
      patterns.push_back(fmt::format("'{} {}'", one.command, name));
    write(fmt::format("{}", fmt::join(patterns, "|")), *option);
  }
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string values;
  std::string words;
  for (const Completion& one : completions_of(program)) {
    for_each_value(one, [&](const std::string& pattern, const CLI::Option& option) {
      values += fmt::format("    {})\n{}      COMPREPLY=($(compgen {} '{}' -- \"$now\"))\n      return ;;\n",
                            pattern, takes_file(option) ? "      compopt -o filenames\n" : "",
                            takes_file(option) ? "-fW" : "-W", joined(choices_of(option)));
    });
    std::vector<std::string> all;
    for (const CLI::App* const command : one.commands) all.push_back(command->get_name());
    for (const CLI::Option* const option : one.options)
      for (const std::string& name : names_of(*option)) all.push_back(name);
    all.insert(all.end(), one.units.begin(), one.units.end());
    words += fmt::format("    '{}') words='{}' ;;\n", one.command, joined(all));
  }
  return fmt::format(R"(# bash completion of {}, made from its own options
_hitpipe() {{
  local now=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command= words= word
  # --format=csv comes as three words
  if [[ $now = = ]]; then now=; elif [[ $before = = ]]; then before=${{COMP_WORDS[COMP_CWORD - 2]}}; fi
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD - 1}}"; do
    case "$command $word" in
      {}) command=${{command:+$command }}$word ;;
    esac
  done
  case "$command $before" in
{}  esac
  case $command in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$now"))
}}
complete -o default -F _hitpipe hitpipe
)",
                     program_version(), command_pattern(program), values, words);
}

std::string zsh_completion(const CLI::App& program) {
  std::string values;
  std::string words;
  for (const Completion& one : completions_of(program)) {
    for_each_value(one, [&](const std::string& pattern, const CLI::Option& option) {
      const std::vector<std::string> choices = choices_of(option);
      values += fmt::format("  ({})\n    {}; return ;;\n", pattern,
                            choices.empty() ? "_files"
                                            : fmt::format("compadd -- {}{}", joined(choices),
                                                          takes_file(option) ? "; _files" : ""));
    });
    words += fmt::format("  ('{}')\n    options=(\n", one.command);
    for (const CLI::Option* const option : one.options)
      for (const std::string& name : names_of(*option))
        words += fmt::format("      {}\n", quoted(fmt::format("{}:{}", name, option->get_description())));
    words += "    )\n    commands=(\n";
    for (const CLI::App* const command : one.commands)
      words += fmt::format("      {}\n",
                           quoted(fmt::format("{}:{}", command->get_name(), command->get_description())));
    words += fmt::format("    )\n{}    ;;\n",
                         one.units.empty() ? "" : fmt::format("    compadd -- {}\n", joined(one.units)));
  }
  return fmt::format(R"(#compdef hitpipe
# zsh completion of {}, made from its own options
local command= word
local -a options commands
for word in ${{words[2,CURRENT-1]}}; do
  case "$command $word" in
    ({}) command=${{command:+$command }}$word ;;
  esac
done
case "$command ${{words[CURRENT-1]}}" in
{}esac
case $command in
{}esac
(( $#commands )) && _describe command commands
if [[ ${{words[CURRENT]}} = -* ]]; then _describe -o option options; else _files; fi
)",
                     program_version(), command_pattern(program), values, words);
}

}  // namespace hitpipe::cli
