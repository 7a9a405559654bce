// A folder of things that are built once and kept by what they were built from. Each is built aside and moved
// into its place whole: processes may race or be killed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hitpipe::sim {

/// Builds `product`s in a folder of the cache that carries the name and a hash of the identity.
struct CacheEntry {
  std::string name;
  std::string identity;               ///< everything that decides what is built
  std::vector<std::string> products;  ///< files: without one of them the entry is not whole
  std::function<void(const std::filesystem::path&)> build;  ///< into an empty folder
};

/// The folder that holds the entry, built unless it is there. What `build` throws goes on to the caller and
/// leaves no entry; throws std::runtime_error, one line, when the cache cannot be written to. Removes what
/// killed processes left an hour ago or earlier.
[[nodiscard]] std::filesystem::path cached(const CacheEntry& entry, const std::filesystem::path& cache);

}  // namespace hitpipe::sim
