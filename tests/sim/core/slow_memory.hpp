// The memory model again, as its description reads: it looks through all requests in every cycle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "sim/core/memory_model.hpp"
#include "tests/sw_ref/memory/aged_set.hpp"

namespace hitpipe::sim {

/// It is always ready.
class SlowMemory {
 public:
  SlowMemory(std::span<const ref::CoreBlock> blocks, const MemoryOptions& options)
      : blocks_(blocks), options_(options), latencies_(options.seed) {}

  void ask(std::uint32_t block, std::uint32_t tag) {
    const bool cached = options_.cache_kib > 0;
    const std::uint32_t line = std::min(block, static_cast<std::uint32_t>(blocks_.size())) / 2;
    Request request{.block = block, .tag = tag, .number = counts.requests++, .ready = {}};
    counts.outside += block >= blocks_.size() ? 1 : 0;
    if (cached && set_of(line).use(line)) {
      ++counts.hits;
      request.ready = cycle_ + static_cast<std::uint64_t>(options_.hit_latency);
    } else {
      ++counts.misses;
      const auto same =
          std::find_if(reads_.begin(), reads_.end(), [&](const Read& r) { return r.line == line; });
      if (cached && same != reads_.end()) {
        ++counts.merged;
        same->requests.push_back(request.number);
      } else {
        counts.bytes_read += cached ? 64 : 32;
        const int latency = latencies_.between(options_.least_latency, options_.most_latency);
        reads_.push_back(
            {line, request.number, cycle_ + static_cast<std::uint64_t>(latency), {request.number}});
      }
    }
    requests_.push_back(request);
    counts.most_waiting = std::max<std::uint64_t>(counts.most_waiting, requests_.size());
  }

  std::optional<MemoryAnswer> step() {
    ++cycle_;
    ++counts.cycles;
    const bool cached = options_.cache_kib > 0;
    const auto read = first(reads_, cycle_);
    if (read != reads_.end() && cycle_ >= free_) {
      free_ = cycle_ + static_cast<std::uint64_t>(cached ? options_.line_interval : options_.interval);
      for (Request& request : requests_)
        if (std::count(read->requests.begin(), read->requests.end(), request.number) > 0)
          request.ready = cycle_;
      if (cached) set_of(read->line).place(read->line);
      reads_.erase(read);
    }
    const auto request = first(requests_, cycle_);
    if (request == requests_.end()) return std::nullopt;
    ++counts.answers;
    MemoryAnswer answer{.tag = request->tag, .number = request->block};
    if (request->block < blocks_.size()) answer.block = blocks_[request->block];
    requests_.erase(request);
    return answer;
  }

  MemoryCounts counts;

 private:
  struct Request {
    std::uint32_t block, tag;
    std::uint64_t number;
    std::optional<std::uint64_t> ready;
  };
  struct Read {
    std::uint32_t line;
    std::uint64_t number;
    std::optional<std::uint64_t> ready;
    std::vector<std::uint64_t> requests;
  };
  ref::AgedSet& set_of(std::uint32_t line) {
    return sets_.try_emplace(line % static_cast<std::uint32_t>(2 * options_.cache_kib), 8).first->second;
  }
  /// What comes next and is ready; the end when there is none.
  template <class Entry>
  typename std::vector<Entry>::iterator first(std::vector<Entry>& all, std::uint64_t cycle) const {
    const auto is_ready = [&](const Entry& e) { return e.ready && *e.ready <= cycle; };
    auto best = all.end();
    for (auto each = all.begin(); each != all.end(); ++each) {
      if (options_.in_order) {
        if (best == all.end() || each->number < best->number) best = each;
      } else if (is_ready(*each) && (best == all.end() || *each->ready < *best->ready ||
                                     (*each->ready == *best->ready && each->number < best->number))) {
        best = each;
      }
    }
    return best != all.end() && is_ready(*best) ? best : all.end();
  }

  std::span<const ref::CoreBlock> blocks_;
  MemoryOptions options_;
  ref::adversary::Random latencies_;
  std::map<std::uint32_t, ref::AgedSet> sets_;
  std::vector<Request> requests_;
  std::vector<Read> reads_;
  std::uint64_t cycle_ = 0, free_ = 0;
};

}  // namespace hitpipe::sim
