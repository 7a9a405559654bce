#include "cli/old_names.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

struct OldCommand {
  std::string_view name;
  std::vector<std::string> today;
};

const std::array<OldCommand, 7> old_commands{{{"designs", {"list", "designs"}},
                                              {"libraries", {"list", "libraries"}},
                                              {"scenes", {"list", "scenes"}},
                                              {"reproduce", {"table", "--judge"}},
                                              {"stiffness", {"check", "--stiff"}},
                                              {"compare", {"render", "--compare"}},
                                              {"rescale", {"render", "--rescale"}}}};

/// Their values are words without an option today.
constexpr std::array<std::string_view, 3> old_options{"--designs", "--design", "--tables"};

/// They took several words.
constexpr std::array<std::string_view, 6> old_lists{"--bits", "--rays-in-flight", "--rows",
                                                    "--only", "--scale",          "--offset"};

template <class Names>
bool is_in(const Names& names, std::string_view word) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

/// The first of the designs that the word names is there.
bool names_a_design(std::string_view word) {
  const std::string_view first = word.substr(0, word.find(','));
  const auto& all = rtl::designs();
  return std::any_of(all.begin(), all.end(), [&](const rtl::Design& design) { return design.name == first; });
}

/// `--arithmetic robust` is `--arithmetic conservative` today.
RenamedWords renamed_arithmetic(std::vector<std::string> words) {
  std::string notice;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const bool is_value = words[i] == "robust" && words[i - 1] == "--arithmetic";
    if (!is_value && words[i] != "--arithmetic=robust") continue;
    words[i] = is_value ? "conservative" : "--arithmetic=conservative";
    notice =
        "`--arithmetic robust` is now `--arithmetic conservative`; the next release takes only the new form";
  }
  return {std::move(words), notice};
}

}  // namespace

RenamedWords renamed(const std::vector<std::string>& words) {
  if (words.empty()) return {};
  if (words.front() == "render") return renamed_arithmetic(words);
  const auto old = std::find_if(old_commands.begin(), old_commands.end(),
                                [&](const OldCommand& command) { return command.name == words.front(); });
  const bool is_old = old != old_commands.end();
  if (!is_old && words.front() != "sweep" && words.front() != "fit") return {words, ""};
  RenamedWords made{is_old ? old->today : std::vector{words.front()}, ""};
  std::vector<std::string> notices;
  std::string list;  // the option whose values follow
  for (auto word = words.begin() + 1; word != words.end(); ++word) {
    const std::string option = word->substr(0, word->find('='));
    if (is_in(old_options, option)) {
      notices.push_back(fmt::format("`{0} X` is now `X`", option));
      if (option == "--design") made.words.front() = "cosim";
      if (option.size() < word->size()) made.words.push_back(word->substr(option.size() + 1));
      list.clear();
    } else if (word->starts_with('-')) {
      made.words.push_back(*word);
      list = is_in(old_lists, *word) && word + 1 != words.end() ? *word : "";
      if (!list.empty()) made.words.push_back(*++word);
    } else {
      if (!list.empty() && !names_a_design(*word)) made.words.push_back(list);
      made.words.push_back(*word);
    }
  }
  if (is_old) {
    const std::vector<std::string> today(made.words.begin(), made.words.begin() + 2);
    notices.insert(notices.begin(), fmt::format("`{}` is now `{}`", old->name, fmt::join(today, " ")));
  }
  if (!notices.empty())
    made.notice = fmt::format("{}; the next release takes only the new form", fmt::join(notices, "; "));
  return made;
}

}  // namespace hitpipe::cli
