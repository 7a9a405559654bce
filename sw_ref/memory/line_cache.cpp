#include "sw_ref/memory/line_cache.hpp"

#include <algorithm>
#include <stdexcept>

namespace hitpipe::ref {

LineCache::LineCache(const CacheShape& shape) : ways_(shape.ways) {
  if (shape.line_bytes == 0) throw std::invalid_argument("a cache with lines of 0 bytes");
  if (shape.bytes == 0) return;
  const std::uint64_t lines = std::max<std::uint64_t>(1, shape.bytes / shape.line_bytes);
  if (ways_ == 0) ways_ = lines;
  sets_.resize(std::max<std::uint64_t>(1, lines / ways_));
}

bool LineCache::use(std::uint32_t line) {
  if (line >= lines_.size() || !lines_[line].present) return false;
  Set& set = set_of(line);
  if (set.newest != line) {
    unlink(set, line);
    link(set, line);
  }
  return true;
}

void LineCache::place(std::uint32_t line) {
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
