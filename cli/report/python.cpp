#include "cli/report/python.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "host/process.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

/// Where the programs are. The name of the folder of sources is as seen from the build folder.
fs::path folder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path().parent_path() / HITPIPE_REPORT_INSTALLED;
  if (fs::exists(installed / "report.py", ignored)) return installed;
  for (fs::path build = program.parent_path(); build.has_relative_path(); build = build.parent_path())
    if (const fs::path built = build / HITPIPE_REPORT_BUILT; fs::exists(built / "report.py", ignored))
      return built.lexically_normal();
  throw std::runtime_error(
      fmt::format("{}: the programs that draw are not there; install hitpipe again", installed.string()));
}

bool has_modules(std::vector<std::string> python) {
  python.insert(python.end(), {"-B", "-c",
                               "import importlib.util, sys; "
                               "sys.exit(not all(map(importlib.util.find_spec, ('matplotlib', 'jinja2'))))"});
  return host::run(python, {.time_limit = host::answering_time}).succeeded();
}

}  // namespace

std::vector<std::string> python_program(const std::string& command, const std::string& file) {
  std::vector<std::vector<std::string>> known{host::program_of("PYTHON", "python3")};
  // Another Python may come first in $PATH, without the distribution's modules.
  if (host::environment("PYTHON", "").empty()) known.push_back({"/usr/bin/python3"});
  for (std::vector<std::string>& python : known) {
    if (!has_modules(python)) continue;
    python.insert(python.end(), {"-B", (folder() / file).string()});
    return python;
  }
  throw std::runtime_error(
      fmt::format("{}: no python3 with matplotlib and jinja2 was found; install the packages "
                  "python3-matplotlib and python3-jinja2 or set PYTHON to the program",
                  command));
}

std::vector<host::File> stiffness_pictures(const std::vector<std::string>& drawer, const std::string& csv,
                                           const std::optional<double>& width_mm) {
  const host::ScratchFolder scratch;
  host::write_file(scratch / "rows.csv", csv);
  std::vector<std::string> words = drawer;
  words.insert(words.end(), {scratch / "rows.csv", scratch.path()});
  if (width_mm) words.push_back(fmt::format("{}", *width_mm));
  const host::Outcome drawn = host::run(words, {.time_limit = host::answering_time});
  if (!drawn.succeeded()) {
    const std::string said = drawn.err.substr(0, drawn.err.find_last_not_of('\n') + 1);
    throw std::runtime_error(
        fmt::format("check: {} {}: {}", words.front(), drawn.failure(), said.substr(said.rfind('\n') + 1)));
  }
  std::vector<host::File> files;
  for (const fs::directory_entry& file : fs::directory_iterator(scratch.path()))
    if (file.path().extension() != ".csv")
      files.push_back({file.path().filename(), host::read_file(file.path())});
  std::ranges::sort(files, {}, &host::File::name);
  return files;
}

}  // namespace hitpipe::cli
