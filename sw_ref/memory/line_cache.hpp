// Which lines of memory a cache holds, and which of them makes room for another one. With pages for lines and a
// single set it is the paged memory of the thesis (section 5.8).
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hitpipe::ref {

/// Which line of a set makes room.
enum class Replacement {
  least_recent,  ///< the one that was not used for the longest time
  /// The first one of age 3. A line that is wanted again has age 0, and a new one 2; then all of its set get older
  /// alike until the oldest have age 3. It is the rule of a core's cache (hls/machines/cache.hpp), after Jaleel et
  /// al., High Performance Cache Replacement Using Re-Reference Interval Prediction, 2010.
  by_age,
};

struct CacheShape {
  std::uint64_t bytes = 0;        ///< 0: there is no cache
  std::uint32_t line_bytes = 64;  ///< >= 1
  std::uint32_t ways = 8;         ///< lines of a set; 0: all lines are one set
  Replacement replacement = Replacement::least_recent;

  friend bool operator==(const CacheShape&, const CacheShape&) = default;
};

/// A line is in the set of its number modulo the number of sets.
class LineCache {
 public:
  /// The cache has whole sets, at least one if it has any bytes. Throws std::invalid_argument for a line of
  /// no bytes.
  explicit LineCache(const CacheShape& shape);

  /// Is the line there? Then it has been used now. By age a call takes time for each line of the set.
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

  [[nodiscard]] bool by_age() const { return !aged_.empty(); }
  /// A way of a set, by age.
  struct Aged {
    std::uint32_t line = none;
    int age = oldest;
  };
  static constexpr int oldest = 3;
  std::span<Aged> ways_of(std::uint32_t line) {
    return std::span(aged_).subspan(line % (aged_.size() / ways_) * ways_, ways_);
  }
  /// Its age is `age`, and all get older.
  static void set_age(std::span<Aged> set, Aged& of, int age);

  std::uint64_t ways_;
  std::vector<Aged> aged_;  ///< set by set
  std::vector<Set> sets_;
  std::vector<Line> lines_;  ///< all that were ever named
};

}  // namespace hitpipe::ref
