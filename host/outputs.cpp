#include "host/outputs.hpp"

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/cannot.hpp"

namespace hitpipe::host {

namespace fs = std::filesystem;

namespace {

using Identity = std::pair<dev_t, ino_t>;

struct Output {
  std::string option;
  fs::path file;
  fs::path canonical;
  std::optional<Identity> identity;  ///< of the file that is there already
};

struct Known {
  std::mutex mutex;
  std::set<Identity> inputs;
  std::set<std::string> input_names;
  std::vector<Output> outputs;
};

Known& known() {
  static Known all;
  return all;
}

[[noreturn]] void refuse_input(const fs::path& output) {
  throw std::runtime_error(
      fmt::format("{}: is an input, which would be lost; give another file to write", output.string()));
}

std::optional<Identity> identity_of(const fs::path& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) return std::nullopt;
  return Identity(found.st_dev, found.st_ino);
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace

void never_replace(const std::string& file) {
  struct stat found {};
  const int failed = file == "-" ? fstat(STDIN_FILENO, &found) : stat(file.c_str(), &found);
  if (failed != 0 || !S_ISREG(found.st_mode)) return;
  const Identity input(found.st_dev, found.st_ino);
  Known& all = known();
  const std::lock_guard lock(all.mutex);
  all.inputs.insert(input);
  if (file != "-") all.input_names.insert(file);
  for (const Output& output : all.outputs)
    if (output.identity == input) refuse_input(output.file);
}

std::vector<std::string> inputs() {
  Known& all = known();
  const std::lock_guard lock(all.mutex);
  return {all.input_names.begin(), all.input_names.end()};
}

void announce_output(std::string_view option, const fs::path& file) {
  if (file == "-") return;
  announce_output_folder(folder_of(file));
  check_replaceable(file);
  std::error_code error;
  fs::path canonical = fs::weakly_canonical(fs::absolute(file, error), error);
  if (error) cannot("write the file", file, error.value());
  Output added{std::string(option), file, std::move(canonical), identity_of(file)};
  Known& all = known();
  const std::lock_guard lock(all.mutex);
  for (const Output& other : all.outputs) {
    const bool same =
        other.canonical == added.canonical || (added.identity && other.identity == added.identity);
    if (same && other.option != added.option)
      throw std::runtime_error(fmt::format("{}: is the file of {} and of {}; give each a file of its own",
                                           file.string(), other.option, option));
  }
  all.outputs.push_back(std::move(added));
}

void announce_output_folder(const fs::path& folder) {
  fs::path there = folder;  // or the nearest above it
  struct stat found {};
  while (stat(there.c_str(), &found) != 0) {
    if (errno != ENOENT && errno != ENOTDIR) cannot("create the folder", folder, errno);
    there = folder_of(there);
  }
  if (!S_ISDIR(found.st_mode)) cannot("create the folder", folder, ENOTDIR);
  if (access(there.c_str(), W_OK | X_OK) != 0)
    cannot(there == folder ? "write to the folder" : "create the folder", folder, errno);
}

void check_replaceable(const fs::path& place) {
  struct stat there {};
  if (stat(place.c_str(), &there) != 0) {
    if (errno == ENAMETOOLONG) cannot("write the file", place, errno);
    return;
  }
  if (S_ISDIR(there.st_mode)) cannot("write the file", place, EISDIR);
  if (!S_ISREG(there.st_mode))
    throw std::runtime_error(fmt::format("{}: is not a file that can be replaced", place.string()));
  Known& all = known();
  const std::lock_guard lock(all.mutex);
  if (all.inputs.contains({there.st_dev, there.st_ino})) refuse_input(place);
}

}  // namespace hitpipe::host
