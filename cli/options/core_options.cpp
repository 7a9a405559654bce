#include "cli/options/core_options.hpp"

#include <algorithm>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/values.hpp"
#include "host/format.hpp"
#include "sim/core/memory_port.hpp"

namespace hitpipe::cli {

namespace {

using rtl::CoreOption;

std::vector<std::string> words_of(const CoreOption& option) {
  std::vector<std::string> words;
  for (const auto& [word, value] : option.words) words.push_back(word);
  return words;
}

/// "a power of two from 2 to 64", "3 to 64".
std::string numbers_of(const CoreOption& option, int most) {
  return fmt::format("{}{} to {}", option.power_of_two ? "a power of two from " : "", option.least, most);
}

int value_of(const CoreOption& option, const std::string& text, int most) {
  for (const auto& [word, value] : option.words)
    if (word == text) return value;
  const std::string name(option.name);
  if (!option.has_numbers())
    throw CLI::ValidationError(
        name, fmt::format("{} is none of {}", host::shortened(text), fmt::join(words_of(option), ", ")));
  const auto number = host::number_in<int>(text);
  const bool allowed = number && *number >= option.least && *number <= most &&
                       (!option.power_of_two || (*number & (*number - 1)) == 0);
  if (!allowed) {
    std::vector<std::string> all = words_of(option);
    all.push_back(numbers_of(option, most));
    throw CLI::ValidationError(
        fmt::format("{} {}: allowed is {}", name, host::shortened(text), fmt::join(all, ", or ")));
  }
  return *number;
}

CLI::Option* add_option(CLI::App& command, const CoreOption& option, rtl::CoreOptions& options,
                        const std::optional<Beyond>& beyond) {
  const std::string name(option.name);
  if (option.is_flag)
    return command.add_flag_callback(
        name, [&option, &options] { option.set(options, 1); }, option.help);
  const int most = beyond ? beyond->most : option.most;
  int* const above = beyond ? &beyond->value : nullptr;
  std::string help = option.help;
  if (option.has_numbers() && option.words.empty())
    help += fmt::format(" ({} to {})", option.least, option.most);
  if (beyond) help += beyond->what;
  const auto take = [&option, &options, most, above](const std::string& text) {
    const int value = value_of(option, text, most);
    const bool is_beyond = above != nullptr && value > option.most;
    if (is_beyond)
      *above = value;
    else
      option.set(options, value);
  };
  const std::string type = !option.type.empty()   ? std::string(option.type)
                           : option.has_numbers() ? "N"
                                                  : fmt::format("{}", fmt::join(words_of(option), "|"));
  CLI::Option* const made = command.add_option_function<std::string>(name, take, help)
                                ->type_name(type)
                                ->default_str(option.text(option.get(options)));
  if (!option.needs.empty()) made->needs(command.get_option(std::string(option.needs)));
  return made;
}

}  // namespace

rtl::CoreOptions CoreChoice::core() const {
  rtl::CoreOptions made = options;
  if (bits) made.bits = parse_bits<hls::RayBits>(*bits);
  return made;
}

void add_core_bits_option(CLI::App& command, std::optional<std::string>& bits, const std::string& otherwise) {
  command
      .add_option("--bits", bits,
                  "Number format of rays, boxes and triangles, for example 20+1/11s20. Default: " + otherwise)
      ->type_name("FORMAT");
}

std::vector<CLI::Option*> add_core_options(CLI::App& command, CoreChoice& choice,
                                           std::initializer_list<CoreOption::Group> groups,
                                           const std::optional<Beyond>& beyond) {
  std::vector<CLI::Option*> added;
  for (const CoreOption::Group group : groups)
    for (const rtl::Feature* const feature : rtl::all_features())
      for (const CoreOption& option : feature->options)
        if (option.group == group)
          added.push_back(add_option(command, option, choice.options,
                                     beyond && beyond->option == option.name ? beyond : std::nullopt));
  return added;
}

void add_memory_option(CLI::App& command, std::string& memory) {
  std::string text = "The memory behind the bus. ";
  for (const sim::KnownMemory& each : sim::known_memories())
    text += fmt::format("{}: {}. ", each.name, each.what);
  text += fmt::format(
      "A JSON file has some of these figures: {}. They may also follow a name: ideal,latency=1..200",
      sim::figure_names());
  command.add_option("--memory", memory, text)->capture_default_str()->type_name("NAME|FILE");
}

}  // namespace hitpipe::cli
