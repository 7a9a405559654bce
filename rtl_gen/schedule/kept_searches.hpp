// Searches for shared components that were made last. Cores and sweeps have the same units again and again, and
// a search takes up to a second.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "rtl_gen/schedule/wider.hpp"

namespace hitpipe::rtl {

class KeptSearches {
 public:
  explicit KeptSearches(std::size_t most) : most_(most) {}

  /// What share_widened() gives. Threads may call it at a time.
  [[nodiscard]] SharedGraph share(const Graph& graph, const Library& library, int interval,
                                  std::optional<int> clock_ps = std::nullopt);
  /// How many were not among the kept ones.
  [[nodiscard]] std::size_t searches() const { return searches_; }

 private:
  struct Search {
    std::string graph;
    Library library;
    int interval;
    std::optional<int> clock_ps;
    SharedGraph found;
  };

  std::mutex mutex_;
  std::size_t most_, searches_ = 0;
  std::deque<Search> kept_;  ///< the oldest first
};

}  // namespace hitpipe::rtl
