#include "host/temporary.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <random>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/files.hpp"
#include "host/text.hpp"

namespace hitpipe::host {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t machine_digits = 8;
constexpr std::size_t random_digits = 16;

/// Names the running kernel, which all containers of a machine share. Another start of the same machine has
/// another name.
const std::string& machine() {
  static const std::string name = [] {
    const std::string boot = contents_of("/proc/sys/kernel/random/boot_id").value_or("");
    return fmt::format("{:08x}", fnv1a(std::as_bytes(std::span(boot))) & 0xFFFFFFFFU);
  }();
  return name;
}

std::string random_name() {
  std::random_device random;
  return fmt::format("{}-{:08x}{:08x}", machine(), random(), random());
}

/// `text` is what random_name() may have made, here or elsewhere.
bool is_random_name(std::string_view text) {
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (text.size() != machine_digits + 1 + random_digits || text[machine_digits] != '-') return false;
  const std::string_view machine_part = text.substr(0, machine_digits);
  const std::string_view random_part = text.substr(machine_digits + 1);
  return std::all_of(machine_part.begin(), machine_part.end(), is_hex) &&
         std::all_of(random_part.begin(), random_part.end(), is_hex);
}

int open_locked(const fs::path& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC, 0666);
  // A file system without locks does not lock.
  if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor);
    errno = EEXIST;
    return -1;
  }
  return descriptor;
}

/// Makes it and locks it. -1: failed, with the reason in errno. EEXIST: somebody has the name, or a cleaner
/// came between.
int make(Temporary::Kind kind, const fs::path& path) {
  const bool is_folder = kind == Temporary::Kind::folder;
  if (is_folder && mkdir(path.c_str(), 0700) != 0) return -1;
  const int descriptor = open_locked(path, is_folder ? O_RDONLY | O_DIRECTORY : O_WRONLY | O_CREAT | O_EXCL);
  if (descriptor < 0) {
    if (is_folder && errno == ENOENT) errno = EEXIST;
    return -1;
  }
  if (access(path.c_str(), F_OK) == 0) return descriptor;
  ::close(descriptor);
  errno = EEXIST;
  return -1;
}

/// `now` is a time of the same file system.
void remove_leftovers(const fs::path& folder, std::string_view prefix, fs::file_time_type now) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& each : fs::directory_iterator(folder, error)) {
    const std::string name = each.path().filename().string();
    if (name.starts_with(prefix) && is_random_name(std::string_view(name).substr(prefix.size())))
      found.push_back(each.path());
  }
  for (const fs::path& path : found) {
    const std::string name = path.filename().string();
    const int descriptor = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;  // gone, or another user's
    const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    const bool lives = !locked && errno == EWOULDBLOCK;
    const bool is_here = locked && name.compare(prefix.size(), machine_digits, machine()) == 0;
    const fs::file_time_type written = fs::last_write_time(path, error);
    const bool is_old = !error && now - written > std::chrono::hours(24);
    if (!lives && (is_here || is_old)) fs::remove_all(path, error);
    ::close(descriptor);
  }
}

}  // namespace

Temporary::Temporary(Kind kind, const fs::path& folder, std::string_view prefix) {
  constexpr int most_attempts = 100;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    path_ = folder / (std::string(prefix) + random_name());
    at_ending_.emplace(AtEnding::Act{.remove = path_.string()});
    descriptor_ = make(kind, path_);
    if (descriptor_ >= 0 || errno != EEXIST) break;
  }
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category());
  std::error_code error;
  const fs::file_time_type now = fs::last_write_time(path_, error);
  if (!error) remove_leftovers(folder, prefix, now);
}

Temporary::~Temporary() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace hitpipe::host
