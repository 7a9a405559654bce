#include "sim/model/build_cache.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "host/file_lock.hpp"
#include "host/files.hpp"
#include "host/text.hpp"

namespace hitpipe::sim {

namespace fs = std::filesystem;

namespace {

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
  if (holds(folder, entry)) return folder;

  const auto refuse = [&] {
    throw std::runtime_error(
        fmt::format("{}: cannot write to the cache; set HITPIPE_CACHE to another folder", cache.string()));
  };
  std::optional<host::FileLock> lock;
  std::optional<host::ScratchFolder> aside;
  try {
    host::make_folder(cache);
    lock.emplace(cache / ".locks", hash);
    if (holds(folder, entry)) return folder;  // somebody has built it meanwhile
    aside.emplace(cache, "building-");
  } catch (const std::runtime_error&) {
    refuse();
  }
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
