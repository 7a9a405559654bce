// A folder that keeps things once they are built. Each is found again by what it was built from. It is built
// in a folder of its own and then moved into place as a whole, because processes may be killed. One process
// builds it, and others that need it wait.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hitpipe::sim {

/// What to build. Its folder in the cache is named after `name` and a hash of `identity`.
struct CacheEntry {
  std::string name;
  std::string identity;               ///< everything that decides what is built
  std::vector<std::string> products;  ///< files; the entry is complete when all are there
  std::function<void(const std::filesystem::path&)> build;  ///< into an empty folder
};

/// The folder that holds the entry. Builds it if it is not there. When `build` throws, the exception goes on
/// to the caller and no entry is left. Throws std::runtime_error, one line, when the cache cannot be written, and
/// when another user owns the cache or the entry, or may write to it. A new cache is for this user alone.
/// Removes what killed processes left behind.
[[nodiscard]] std::filesystem::path cached(const CacheEntry& entry, const std::filesystem::path& cache);

}  // namespace hitpipe::sim
