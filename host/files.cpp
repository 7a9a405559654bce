#include "host/files.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hitpipe::host {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw std::runtime_error(
      fmt::format("{}: cannot {}: {}", path.string(), what, std::generic_category().message(error)));
}

/// A temporary file's name begins with this, and with the name that it will have, which may be long.
std::string prefix_aside(const fs::path& place) {
  constexpr std::size_t longest = 100;
  return fmt::format(".{}.hitpipe-", place.filename().string().substr(0, longest));
}

/// Files by device and number.
class Identities {
 public:
  void add(const struct stat& file) {
    const std::lock_guard lock(mutex_);
    files_.emplace(file.st_dev, file.st_ino);
  }
  [[nodiscard]] bool has(const struct stat& file) {
    const std::lock_guard lock(mutex_);
    return files_.contains({file.st_dev, file.st_ino});
  }

 private:
  std::mutex mutex_;
  std::set<std::pair<dev_t, ino_t>> files_;
};

Identities& inputs() {
  static Identities all;
  return all;
}

}  // namespace

void never_replace(const std::string& file) {
  struct stat found {};
  const int failed = file == "-" ? fstat(STDIN_FILENO, &found) : stat(file.c_str(), &found);
  if (failed == 0 && S_ISREG(found.st_mode)) inputs().add(found);
}

std::optional<std::string> contents_of(const fs::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rbe"), std::fclose);
  if (in == nullptr) return std::nullopt;
  std::string contents;
  std::array<char, 1 << 16> buffer;
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), in.get()))
    contents.append(buffer.data(), got);
  return std::ferror(in.get()) == 0 ? std::optional(std::move(contents)) : std::nullopt;
}

std::string read_file(const fs::path& file, std::string_view complaint) {
  if (std::optional<std::string> contents = contents_of(file)) return *std::move(contents);
  throw std::runtime_error(fmt::format("{}: {}", file.string(), complaint));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, "create the folder", error.value());
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail(folder, "write to the folder", errno);
}

PendingFile::PendingFile(fs::path place) : place_(std::move(place)) {
  const fs::path folder = place_.has_parent_path() ? place_.parent_path() : fs::path(".");
  make_folder(folder);
  // No rename may fail half-way, and none may replace a device such as /dev/null.
  std::error_code ignored;
  if (fs::is_directory(place_, ignored)) fail(place_, "write the file", EISDIR);
  if (fs::exists(place_, ignored) && !fs::is_regular_file(place_, ignored))
    throw std::runtime_error(fmt::format("{}: is not a file that can be replaced", place_.string()));
  struct stat there {};
  const bool is_there = stat(place_.c_str(), &there) == 0;
  if (!is_there && errno == ENAMETOOLONG) fail(place_, "write the file", errno);
  if (is_there && inputs().has(there))
    throw std::runtime_error(
        fmt::format("{}: is an input, which would be lost; give another file to write", place_.string()));
  try {
    aside_ = std::make_unique<Temporary>(Temporary::Kind::file, folder, prefix_aside(place_));
  } catch (const std::system_error& error) {
    fail(place_, "write the file", error.code().value());
  }
  // The lock outlasts this stream.
  file_ = fdopen(fcntl(aside_->descriptor(), F_DUPFD_CLOEXEC, 0), "wb");
  if (file_ == nullptr) fail(place_, "write the file", errno);
}

PendingFile::~PendingFile() {
  if (file_ != nullptr) static_cast<void>(std::fclose(file_));
  std::error_code ignored;
  if (aside_ != nullptr) fs::remove(aside_->path(), ignored);
}

void PendingFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(place_, "write the file", errno);
}

void PendingFile::close() {
  // A file system that cannot be synchronised says EINVAL.
  if (std::fflush(file_) != 0 || (fsync(fileno(file_)) != 0 && errno != EINVAL))
    fail(place_, "write the file", errno);
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(place_, "write the file", errno);
}

void PendingFile::rename() {
  std::error_code error;
  fs::rename(aside_->path(), place_, error);
  if (error) fail(place_, "write the file", error.value());
  aside_.reset();
}

void write_files(const fs::path& folder, const std::vector<File>& files) {
  std::deque<PendingFile> pending;
  for (const File& file : files) {
    pending.emplace_back(folder / file.name);
    pending.back().write(file.contents);
    pending.back().close();
  }
  for (PendingFile& file : pending) file.rename();
}

void write_file(const fs::path& file, std::string_view contents) {
  PendingFile pending(file);
  pending.write(contents);
  pending.close();
  pending.rename();
}

ScratchFolder::ScratchFolder(const std::string& prefix) : ScratchFolder(fs::temp_directory_path(), prefix) {}

ScratchFolder::ScratchFolder(const fs::path& parent, const std::string& prefix) {
  try {
    made_ = std::make_unique<Temporary>(Temporary::Kind::folder, parent, prefix);
  } catch (const std::system_error& error) {
    throw std::runtime_error(
        fmt::format("{}: cannot create a folder in it: {}", parent.string(), error.code().message()));
  }
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path(), ignored);
}

}  // namespace hitpipe::host
