// A set of a cache by age (sw_ref/memory/line_cache.hpp), by its definition: ages grow one by one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace hitpipe::ref {

class AgedSet {
 public:
  explicit AgedSet(std::size_t ways) : ways_(ways, {~0U, 3}) {}

  /// Is the line there? Then a ray wants it again.
  bool use(std::uint32_t line) {
    for (auto& [held, age] : ways_)
      if (held == line) return has_now(age, 0), true;
    return false;
  }
  void place(std::uint32_t line) {
    for (auto& [held, age] : ways_) {
      if (age != 3) continue;
      held = line;
      return has_now(age, 2);
    }
    throw std::logic_error("no line has the age 3");
  }

 private:
  void has_now(int& age, int value) {
    age = value;
    while (std::none_of(ways_.begin(), ways_.end(), [](const auto& way) { return way.second == 3; }))
      for (auto& way : ways_) ++way.second;
  }
  std::vector<std::pair<std::uint32_t, int>> ways_;
};

}  // namespace hitpipe::ref
