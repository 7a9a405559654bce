// Which lines of memory a cache of eight ways holds: the least recently used line of a set makes room.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hitpipe::sim {

/// A line is in the set of its number modulo the number of sets.
class LineCache {
 public:
  static constexpr std::size_t ways = 8;
  static constexpr std::size_t line_bytes = 64;

  /// Of a power of two of KiB, or of 0: then it never holds a line.
  explicit LineCache(int kib)
      : sets_(static_cast<std::size_t>(kib) * 1024 / (ways * line_bytes), empty_set()) {}

  /// Is the line there? Then it has been used now.
  bool use(std::uint32_t line) {
    if (sets_.empty()) return false;
    Set& set = set_of(line);
    auto* const way = std::find(set.begin(), set.end(), line);
    if (way == set.end()) return false;
    std::rotate(set.begin(), way, way + 1);
    return true;
  }
  /// Takes a line in that is not there. It has been used now.
  void place(std::uint32_t line) {
    Set& set = set_of(line);
    std::rotate(set.begin(), set.end() - 1, set.end());
    set.front() = line;
  }

 private:
  using Set = std::array<std::uint32_t, ways>;  ///< the last used line first
  static Set empty_set() {
    Set set{};
    set.fill(0xFFFF'FFFF);  // no line: a line has at least two blocks
    return set;
  }
  Set& set_of(std::uint32_t line) { return sets_[line & (sets_.size() - 1)]; }

  std::vector<Set> sets_;
};

}  // namespace hitpipe::sim
