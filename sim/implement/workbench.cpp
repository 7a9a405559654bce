#include "sim/implement/workbench.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace fs = std::filesystem;

Workbench::Workbench(fs::path kept) : kept_(std::move(kept)), work_(scratch_ / kept_.filename().string()) {
  host::make_folder(kept_);
  host::make_folder(work_);
}

void Workbench::put(const host::File& file) const {
  host::write_file(work_ / file.name, file.contents);
}

void Workbench::keep(const std::string& name) const {
  host::write_file(kept_ / name, read(name));
}

void Workbench::put_and_keep(const host::File& file) const {
  put(file);
  host::write_file(kept_ / file.name, file.contents);
}

std::string Workbench::read(const std::string& name) const {
  if (std::optional<std::string> contents = host::contents_of(work_ / name)) return *std::move(contents);
  throw std::runtime_error(fmt::format("{}: a tool did not write it", name));
}

host::Outcome Workbench::try_run(const Tool& tool, const std::vector<std::string>& arguments,
                                 const std::string& log) const {
  host::Outcome outcome = tool.run(arguments, work_);
  host::write_file(kept_ / log, outcome.out + outcome.err);
  return outcome;
}

std::string Workbench::run(const Tool& tool, const std::vector<std::string>& arguments,
                           const std::string& log) const {
  const host::Outcome outcome = try_run(tool, arguments, log);
  if (!outcome.succeeded())
    throw std::runtime_error(
        fmt::format("{}: {}; its output is in {}", tool.name(), outcome.failure(), (kept_ / log).string()));
  return outcome.out + outcome.err;
}

}  // namespace hitpipe::sim
