#include "sim/model/build_cache.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/file_lock.hpp"
#include "host/files.hpp"
#include "host/text.hpp"

namespace hitpipe::sim {

namespace fs = std::filesystem;

namespace {

/// What stands here is code that runs. Another user could also turn a link of his own elsewhere.
void check_own(const fs::path& path) {
  struct stat link {};
  struct stat status {};
  if (lstat(path.c_str(), &link) != 0 || stat(path.c_str(), &status) != 0) return;  // not there
  const bool own = link.st_uid == geteuid() && status.st_uid == geteuid();
  if (own && (!S_ISDIR(status.st_mode) || (status.st_mode & (S_IWGRP | S_IWOTH)) == 0)) return;
  throw std::runtime_error(
      fmt::format("{}: {}, so the code in it is not run; set HITPIPE_CACHE to another folder{}",
                  path.string(), own ? "other users may write to it" : "belongs to another user",
                  own ? ", or take that right from them (chmod go-w)" : ""));
}

/// New folders are for this user alone.
void make_cache(const fs::path& cache) {
  const fs::path folder = (cache / "").parent_path();
  std::error_code ignored;
  fs::create_directories(folder.parent_path(), ignored);
  static_cast<void>(mkdir(folder.c_str(), 0700));  // a failure shows below
  host::make_folder(folder);
}

/// The folder is this entry, and all its products are there.
bool holds(const fs::path& folder, const CacheEntry& entry) {
  return std::all_of(entry.products.begin(), entry.products.end(),
                     [&](const std::string& product) {
                       std::error_code ignored;
                       return fs::exists(folder / product, ignored);
                     }) &&
         host::contents_of(folder / "identity") == entry.identity;
}

}  // namespace

fs::path cached(const CacheEntry& entry, const fs::path& cache) {
  // Identities are compared too. If two have the same hash, one of them is built again.
  const std::uint64_t hash = host::fnv1a(std::as_bytes(std::span(entry.identity)));
  const fs::path folder = cache / fmt::format("{}-{:016x}", entry.name, hash);
  check_own(cache);
  check_own(folder);
  for (const std::string& product : entry.products) check_own(folder / product);
  if (holds(folder, entry)) return folder;

  const auto refuse = [&] {
    throw std::runtime_error(
        fmt::format("{}: cannot write to the cache; set HITPIPE_CACHE to another folder", cache.string()));
  };
  std::optional<host::FileLock> lock;
  std::optional<host::ScratchFolder> aside;
  try {
    make_cache(cache);
    lock.emplace(cache / ".locks", hash);
    if (holds(folder, entry)) return folder;  // somebody has built it meanwhile
    aside.emplace(cache, "building-");
  } catch (const std::runtime_error&) {
    refuse();
  }
  check_own(cache);  // somebody may have made it meanwhile
  entry.build(aside->path());
  host::write_file(*aside / "identity", entry.identity);
  std::error_code error;
  fs::rename(aside->path(), folder, error);
  if (error && !holds(folder, entry)) {
    // A damaged entry, or another entry with the same hash.
    fs::remove_all(folder, error);
    fs::rename(aside->path(), folder, error);
  }
  if (error && !holds(folder, entry)) refuse();
  return folder;
}

}  // namespace hitpipe::sim
