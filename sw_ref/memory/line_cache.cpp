#include "sw_ref/memory/line_cache.hpp"

#include <algorithm>
#include <stdexcept>

namespace hitpipe::ref {

LineCache::LineCache(const CacheShape& shape) : ways_(shape.ways) {
  if (shape.line_bytes == 0) throw std::invalid_argument("a cache with lines of 0 bytes");
  if (shape.bytes == 0) return;
  const std::uint64_t lines = std::max<std::uint64_t>(1, shape.bytes / shape.line_bytes);
  if (ways_ == 0) ways_ = lines;
  const std::uint64_t sets = std::max<std::uint64_t>(1, lines / ways_);
  if (shape.replacement == Replacement::by_age)
    aged_.resize(sets * ways_);
  else
    sets_.resize(sets);
}

bool LineCache::use(std::uint32_t line) {
  if (by_age()) {
    const std::span<Aged> set = ways_of(line);
    const auto found =
        std::find_if(set.begin(), set.end(), [&](const Aged& way) { return way.line == line; });
    if (found == set.end()) return false;
    set_age(set, *found, 0);
    return true;
  }
  if (line >= lines_.size() || !lines_[line].present) return false;
  Set& set = set_of(line);
  if (set.newest != line) {
    unlink(set, line);
    link(set, line);
  }
  return true;
}

void LineCache::place(std::uint32_t line) {
  if (by_age()) {
    const std::span<Aged> set = ways_of(line);
    // Some way has the highest age, from the beginning on.
    Aged& leaving = *std::find_if(set.begin(), set.end(), [](const Aged& way) { return way.age == oldest; });
    leaving.line = line;
    set_age(set, leaving, 2);
    return;
  }
  if (sets_.empty()) return;
  if (line >= lines_.size()) lines_.resize(std::size_t{line} + 1);
  Set& set = set_of(line);
  if (set.lines == ways_) {
    const std::uint32_t leaving = set.oldest;
    unlink(set, leaving);
    lines_[leaving].present = false;
  } else {
    ++set.lines;
  }
  lines_[line].present = true;
  link(set, line);
}

void LineCache::set_age(std::span<Aged> set, Aged& of, int age) {
  of.age = age;
  const int most = std::max_element(set.begin(), set.end(), [](const Aged& a, const Aged& b) {
                     return a.age < b.age;
                   })->age;
  for (Aged& way : set) way.age += oldest - most;
}

void LineCache::link(Set& set, std::uint32_t line) {
  lines_[line].newer = none;
  lines_[line].older = set.newest;
  (set.newest == none ? set.oldest : lines_[set.newest].newer) = line;
  set.newest = line;
}

void LineCache::unlink(Set& set, std::uint32_t line) {
  const Line& at = lines_[line];
  (at.newer == none ? set.newest : lines_[at.newer].older) = at.older;
  (at.older == none ? set.oldest : lines_[at.older].newer) = at.newer;
}

}  // namespace hitpipe::ref
