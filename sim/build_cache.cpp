#include "sim/build_cache.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace fs = std::filesystem;

namespace {

/// FNV-1a, 64 bits: names an entry. Identities are compared too, so a collision only costs a build.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Build folders that nobody has touched for an hour.
void remove_abandoned(const fs::path& cache) {
  std::error_code ignored;
  for (const auto& each : fs::directory_iterator(cache, ignored)) {
    if (!each.path().filename().string().starts_with("building-")) continue;
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(each.path(), ignored);
    if (age > std::chrono::hours(1)) fs::remove_all(each.path(), ignored);
  }
}

/// Whether the folder is the entry, and whole.
bool holds(const fs::path& folder, const CacheEntry& entry) {
  return std::all_of(entry.products.begin(), entry.products.end(),
                     [&](const std::string& product) {
                       std::error_code ignored;
                       return fs::exists(folder / product, ignored);
                     }) &&
         read_file(folder / "identity") == entry.identity;
}

}  // namespace

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot write the file", path.string()));
}

fs::path cached(const CacheEntry& entry, const fs::path& cache) {
  const fs::path folder = cache / fmt::format("{}-{:016x}", entry.name, hash_of(entry.identity));
  if (holds(folder, entry)) return folder;

  const auto refuse = [&] {
    throw std::runtime_error(
        fmt::format("{}: cannot write to the cache; set HITPIPE_CACHE to another folder", cache.string()));
  };
  std::error_code error;
  fs::create_directories(cache, error);
  std::string aside = (cache / "building-XXXXXX").string();
  if (error || mkdtemp(aside.data()) == nullptr) refuse();
  remove_abandoned(cache);
  try {
    entry.build(aside);
    write_file(fs::path(aside) / "identity", entry.identity);
    fs::rename(aside, folder, error);
    if (error && !holds(folder, entry)) {
      // A damaged entry, or another of the same hash.
      fs::remove_all(folder, error);
      fs::rename(aside, folder, error);
    }
    if (error && !holds(folder, entry)) refuse();
    fs::remove_all(aside, error);  // still there when another process was first
  } catch (...) {
    fs::remove_all(aside, error);
    throw;
  }
  return folder;
}

}  // namespace hitpipe::sim
