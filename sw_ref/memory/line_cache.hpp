// Which lines of memory a cache holds: the least recently used line of a set makes room. With pages for lines
// and a single set it is the paged memory of the thesis (section 5.8).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace hitpipe::ref {

struct CacheShape {
  std::uint64_t bytes = 0;        ///< 0: there is no cache
  std::uint32_t line_bytes = 64;  ///< >= 1
  std::uint32_t ways = 8;         ///< lines of a set; 0: all lines are one set

  friend bool operator==(const CacheShape&, const CacheShape&) = default;
};

/// A line is in the set of its number modulo the number of sets.
class LineCache {
 public:
  /// The cache has whole sets, at least one if it has any bytes. Throws std::invalid_argument for a line of
  /// no bytes.
  explicit LineCache(const CacheShape& shape);

  /// Is the line there? Then it has been used now.
  bool use(std::uint32_t line);
  /// Takes a line in that is not there. It has been used now. Without a cache nothing happens.
  void place(std::uint32_t line);

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  /// Neighbours in the list of its set, from the most to the least recently used line.
  struct Line {
    std::uint32_t newer = none;
    std::uint32_t older = none;
    bool present = false;
  };
  struct Set {
    std::uint32_t newest = none;
    std::uint32_t oldest = none;
    std::uint64_t lines = 0;
  };

  Set& set_of(std::uint32_t line) { return sets_[line % sets_.size()]; }
  void link(Set& set, std::uint32_t line);
  void unlink(Set& set, std::uint32_t line);

  std::uint64_t ways_;
  std::vector<Set> sets_;
  std::vector<Line> lines_;  ///< all that were ever named
};

}  // namespace hitpipe::ref
