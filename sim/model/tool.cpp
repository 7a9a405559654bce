#include "sim/model/tool.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/process.hpp"
#include "host/text.hpp"

namespace hitpipe::sim {

std::string Tool::name() const {
  return fmt::format("{}", fmt::join(words, " "));
}

host::Outcome Tool::run(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                        std::chrono::milliseconds time_limit) const {
  std::vector<std::string> all = words;
  all.insert(all.end(), arguments.begin(), arguments.end());
  return host::run(all, {.folder = folder, .time_limit = time_limit});
}

namespace {

std::string without_last_newlines(const std::string& text) {
  return text.substr(0, text.find_last_not_of('\n') + 1);
}

/// Why a program did not say its version: in its own words, if it has any. Nothing when its name says it all.
std::string why(const Tool& tool, const host::Outcome& asked) {
  if (asked.not_found())
    return tool.words.size() == 1 ? "" : fmt::format("{} was not found", tool.words.front());
  const std::string& output = asked.err.empty() ? asked.out : asked.err;
  const std::string said = output.substr(0, output.find('\n'));
  const std::string ended = asked.succeeded() ? "it does not say its version" : "it " + asked.failure();
  return said.empty() ? ended : fmt::format("{}: {}", ended, host::shortened(said));
}

}  // namespace

std::string Tool::answer(const std::vector<std::string>& arguments) const {
  const host::Outcome outcome = run(arguments, {}, host::answering_time);
  return outcome.succeeded() ? without_last_newlines(outcome.out) : "";
}

std::runtime_error cannot_be_run(const Tool& tool, std::string_view package, const std::string& variable,
                                 const std::string& why) {
  const std::string install = package.empty() ? "" : fmt::format("install the package {} or ", package);
  return std::runtime_error(fmt::format("{}: cannot be run{}; {}set {} to the program", tool.name(),
                                        why.empty() ? "" : fmt::format(" ({})", why), install, variable));
}

Tool find_tool(const char* variable, const std::string& otherwise, std::string_view package,
               const std::string& version_option) {
  Tool tool{host::program_of(variable, otherwise), ""};
  std::string& program = tool.words.front();
  if (program.find('/') != std::string::npos) program = std::filesystem::absolute(program).string();
  const host::Outcome asked = tool.run({version_option}, {}, host::answering_time);
  if (asked.stopped_after.count() != 0)
    throw std::runtime_error(fmt::format("{} {}: {}", tool.name(), version_option, asked.failure()));
  if (asked.succeeded()) tool.version = without_last_newlines(asked.out.empty() ? asked.err : asked.out);
  if (tool.version.empty()) throw cannot_be_run(tool, package, variable, why(tool, asked));
  return tool;
}

}  // namespace hitpipe::sim
