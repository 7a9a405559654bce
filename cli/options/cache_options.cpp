#include "cli/options/cache_options.hpp"

#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"

namespace hitpipe::cli {

std::vector<ref::CacheShape> CacheChoice::shapes(ref::Replacement replacement) const {
  std::vector<ref::CacheShape> all;
  for (const int size : kib)
    all.push_back({.bytes = static_cast<std::uint64_t>(size) << 10,
                   .line_bytes = line_bytes,
                   .ways = ways,
                   .replacement = ways == 0 ? ref::Replacement::least_recent : replacement});
  return all;
}

CLI::Option* add_cache_options(CLI::App& command, CacheChoice& caches) {
  CLI::Option* const sizes = add_list_option(
      command, "--cache", caches.kib,
      "Also count the bytes that memory gives for a ray: without a cache, and behind caches of "
      "so many KiB, with one thread (1 to 1048576)",
      "KIB");
  sizes->transform(number_from(1, 1 << 20));
  const auto of_caches = [&](const char* name, std::uint32_t& value, const char* what,
                             std::vector<std::uint32_t> allowed) {
    command.add_option(name, value, what)
        ->check(CLI::IsMember(std::move(allowed)).description(""))
        ->needs(sizes)
        ->capture_default_str()
        ->type_name("N");
  };
  of_caches("--cache-line", caches.line_bytes, "Bytes of a line: 16, 32, 64, 128, 256 or 4096",
            {16, 32, 64, 128, 256, 4096});
  of_caches("--cache-ways", caches.ways, "Lines of a set: 1, 2, 4, 8, 16, or 0 for all in one set",
            {0, 1, 2, 4, 8, 16});
  return sizes;
}

void add_read_bytes(Row& row, std::string_view name, const ref::ReadBytes& read, const CacheChoice& caches) {
  const auto per_ray = [&](std::uint64_t bytes) {
    return read.rays == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(read.rays);
  };
  row[std::string(name)] = per_ray(read.without_cache);
  for (std::size_t i = 0; i < caches.kib.size(); ++i)
    row[fmt::format("{}_{}kib", name, caches.kib[i])] = per_ray(read.behind[i]);
}

}  // namespace hitpipe::cli
