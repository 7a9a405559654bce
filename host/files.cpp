#include "host/files.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/cannot.hpp"
#include "host/outputs.hpp"

namespace hitpipe::host {

namespace fs = std::filesystem;

namespace {

/// A temporary file's name begins with this, and with the name that it will have, which may be long.
std::string prefix_aside(const fs::path& place) {
  constexpr std::size_t longest = 100;
  return fmt::format(".{}.hitpipe-", place.filename().string().substr(0, longest));
}

void fill(PendingFile& file, std::string_view contents) {
  file.write(contents);
  if (contents.starts_with("#!")) file.make_program();
  file.close();
}

}  // namespace

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
  if (error) cannot("create the folder", folder, error.value());
  if (access(folder.c_str(), W_OK | X_OK) != 0) cannot("write to the folder", folder, errno);
}

PendingFile::PendingFile(fs::path place) : place_(std::move(place)) {
  const fs::path folder = place_.has_parent_path() ? place_.parent_path() : fs::path(".");
  make_folder(folder);
  check_replaceable(place_);  // so that no rename fails half-way
  try {
    aside_ = std::make_unique<Temporary>(Temporary::Kind::file, folder, prefix_aside(place_));
  } catch (const std::system_error& error) {
    cannot("write the file", place_, error.code().value());
  }
  // The lock outlasts this stream.
  file_ = fdopen(fcntl(aside_->descriptor(), F_DUPFD_CLOEXEC, 0), "wb");
  if (file_ == nullptr) cannot("write the file", place_, errno);
}

PendingFile::~PendingFile() {
  if (file_ != nullptr) static_cast<void>(std::fclose(file_));
  std::error_code ignored;
  if (aside_ != nullptr) fs::remove(aside_->path(), ignored);
}

void PendingFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) cannot("write the file", place_, errno);
}

void PendingFile::make_program() {
  struct stat status {};
  if (fstat(fileno(file_), &status) != 0 ||
      fchmod(fileno(file_), status.st_mode | (status.st_mode & (S_IRUSR | S_IRGRP | S_IROTH)) >> 2U) != 0)
    cannot("write the file", place_, errno);
}

void PendingFile::close() {
  // A file system that cannot be synchronised says EINVAL.
  if (std::fflush(file_) != 0 || (fsync(fileno(file_)) != 0 && errno != EINVAL))
    cannot("write the file", place_, errno);
  if (std::fclose(std::exchange(file_, nullptr)) != 0) cannot("write the file", place_, errno);
}

void PendingFile::rename() {
  std::error_code error;
  fs::rename(aside_->path(), place_, error);
  if (error) cannot("write the file", place_, error.value());
  aside_.reset();
}

void write_files(const fs::path& folder, const std::vector<File>& files) {
  std::deque<PendingFile> pending;
  for (const File& file : files) {
    pending.emplace_back(folder / file.name);
    fill(pending.back(), file.contents);
  }
  for (PendingFile& file : pending) file.rename();
}

void write_file(const fs::path& file, std::string_view contents) {
  PendingFile pending(file);
  fill(pending, contents);
  pending.rename();
}

void append_to_file(const fs::path& file, std::string_view text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) cannot("write the file", file, errno);
  const off_t end = lseek(descriptor, 0, SEEK_END);
  int error = 0;
  while (!text.empty() && error == 0) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written >= 0) text.remove_prefix(static_cast<std::size_t>(written));
    if (written < 0 && errno != EINTR) error = errno;
  }
  if (error == 0 && fsync(descriptor) != 0 && errno != EINVAL) error = errno;
  if (error != 0) static_cast<void>(ftruncate(descriptor, end) == 0);  // the first error is the one to tell
  static_cast<void>(close(descriptor));
  if (error != 0) cannot("write the file", file, error);
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
