// The caches that a command counts bytes of memory behind.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "cli/text/table.hpp"
#include "sw_ref/memory/read_bytes.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

struct CacheChoice {
  std::vector<int> kib;  ///< empty: reads of memory are not counted
  std::uint32_t line_bytes = ref::CacheShape{}.line_bytes;
  std::uint32_t ways = ref::CacheShape{}.ways;

  /// With all lines in one set the least recently used one makes room.
  [[nodiscard]] std::vector<ref::CacheShape> shapes(
      ref::Replacement replacement = ref::Replacement::least_recent) const;
};

/// Adds --cache, --cache-line and --cache-ways. Returns --cache.
CLI::Option* add_cache_options(CLI::App& command, CacheChoice& caches);

/// Adds a column `name`, the bytes a ray without a cache, and a column for each cache, such as `name`_16kib.
void add_read_bytes(Row& row, std::string_view name, const ref::ReadBytes& read, const CacheChoice& caches);

}  // namespace hitpipe::cli
