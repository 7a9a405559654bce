#include "sim/core/memory_model.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace {

void check_cycles(const char* what, int cycles) {
  if (cycles < 1 || cycles > MemoryOptions::most_cycles)
    throw std::invalid_argument(fmt::format("a memory's {} of {} cycles: allowed is 1 to {}", what, cycles,
                                            MemoryOptions::most_cycles));
}

void check_rows(const DramRows& rows) {
  const auto is_power = [](int x) { return x > 0 && (x & (x - 1)) == 0; };
  if (rows.row_bytes != 0 && (!is_power(rows.row_bytes) || rows.row_bytes < 64))
    throw std::invalid_argument(fmt::format(
        "a memory's rows of {} bytes: allowed is 0 or a power of two from 64 on", rows.row_bytes));
  if (!is_power(rows.banks))
    throw std::invalid_argument(fmt::format("a memory of {} banks: allowed is a power of two", rows.banks));
}

const MemoryOptions& checked(const MemoryOptions& options) {
  check_cycles("latency", options.least_latency);
  check_cycles("latency", options.most_latency);
  if (options.least_latency > options.most_latency)
    throw std::invalid_argument(fmt::format("a memory's latency of {} to {} cycles: the least comes first",
                                            options.least_latency, options.most_latency));
  check_cycles("interval", options.interval);
  check_cycles("interval of lines", options.line_interval);
  check_cycles("hit latency", options.hit_latency);
  check_rows(options.rows);
  if (options.refused_percent < 0 || options.refused_percent > 99)
    throw std::invalid_argument(fmt::format("a memory that refuses in {} % of the cycles: allowed is 0 to 99",
                                            options.refused_percent));
  if (options.error_percent < 0 || options.error_percent > 99)
    throw std::invalid_argument(fmt::format(
        "a memory that gives {} % of its answers as errors: allowed is 0 to 99", options.error_percent));
  if (options.most_waiting < 0)
    throw std::invalid_argument(
        fmt::format("a memory with at most {} requests on their way: allowed is 1 or more, or 0 for no limit",
                    options.most_waiting));
  const int kib = options.cache_kib;
  if (kib < 0 || kib > MemoryOptions::most_cache_kib || (kib & (kib - 1)) != 0)
    throw std::invalid_argument(fmt::format("a cache of {} KiB: allowed is 0 or a power of two up to {}", kib,
                                            MemoryOptions::most_cache_kib));
  return options;
}

constexpr std::uint64_t no_row = ~std::uint64_t{0};
constexpr std::uint32_t blocks_of_line = ref::CacheShape{}.line_bytes / ref::core_block_bytes;

}  // namespace

std::uint32_t MemoryModel::line_of(std::uint32_t block) const {
  return std::min(block, static_cast<std::uint32_t>(blocks_.size())) / blocks_of_line;
}

MemoryCounts& MemoryCounts::operator+=(const MemoryCounts& later) {
  cycles += later.cycles;
  requests += later.requests;
  outside += later.outside;
  hits += later.hits;
  misses += later.misses;
  merged += later.merged;
  bytes_read += later.bytes_read;
  answers += later.answers;
  most_waiting = std::max(most_waiting, later.most_waiting);
  return *this;
}

MemoryModel::MemoryModel(std::span<const ref::CoreBlock> blocks, const MemoryOptions& options)
    : blocks_(blocks),
      options_(checked(options)),
      read_bytes_(options.cache_kib > 0 ? ref::CacheShape{}.line_bytes
                  : options.reads_lines ? static_cast<std::uint64_t>(options.line_bytes)
                                        : ref::core_block_bytes),
      read_cycles_(static_cast<std::uint64_t>(
          options.cache_kib > 0 || options.reads_lines ? options.line_interval : options.interval)),
      latencies_(options.seed),
      refusals_(~options.seed),
      errors_(options.seed + 1),
      cache_({.bytes = static_cast<std::uint64_t>(options.cache_kib) << 10,
              .replacement = ref::Replacement::by_age}) {
  if (!options.in_order && options.least_latency < options.most_latency)
    calendar_.resize(std::bit_ceil(static_cast<std::size_t>(options.most_latency)));
  if (options.cache_kib > 0) on_their_way_.resize(buckets, no_place);
  if (options.rows.row_bytes > 0) open_rows_.resize(static_cast<std::size_t>(options.rows.banks), no_row);
  next_refresh_ = static_cast<std::uint64_t>(options.rows.refresh_every);
  decide_ready();
}

void MemoryModel::ask(std::uint32_t block, std::uint32_t tag) {
  if (!ready_) throw std::logic_error("a memory was asked in a cycle in which it is not ready");
  if (asked_) throw std::logic_error("a memory was asked twice in a cycle");
  asked_ = true;
  if (block < blocks_.size()) {
    __builtin_prefetch(&blocks_[block]);  // it is read many cycles later
  } else {
    ++counts_.outside;
  }
  const std::uint32_t place = requests_.take(block, tag, counts_.requests);
  ++counts_.requests;
  counts_.most_waiting = std::max(counts_.most_waiting, ++waiting_);

  const bool hit = cache_.use(line_of(block));
  if (hit || options_.in_order) in_turn_.push(requests_, place);
  if (hit) {
    ++counts_.hits;
    requests_[place].ready = now_ + static_cast<std::uint64_t>(options_.hit_latency);
    requests_[place].given = true;
    return;
  }
  ++counts_.misses;
  if (on_their_way_.empty() || !merge(place)) read(place);
}

/// With a cache: lets it wait for the read of its line that is on its way. False when there is none; it is
/// then noted as that read.
bool MemoryModel::merge(std::uint32_t request) {
  const std::uint32_t line = line_of(requests_[request].block);
  std::uint32_t& bucket = on_their_way_[line % buckets];
  for (std::uint32_t read = bucket; read != no_place; read = requests_[read].next_of_bucket) {
    if (line_of(requests_[read].block) != line) continue;
    requests_[read].merged.push(requests_, request);
    ++counts_.merged;
    return true;
  }
  requests_[request].next_of_bucket = bucket;
  bucket = request;
  return false;
}

void MemoryModel::read(std::uint32_t request) {
  counts_.bytes_read += read_bytes_;
  const std::uint64_t ready =
      now_ + static_cast<std::uint64_t>(latencies_.between(options_.least_latency, options_.most_latency));
  requests_[request].ready = ready;
  Reads& reads = calendar_.empty() ? reads_ : calendar_[ready & (calendar_.size() - 1)];
  reads.push(requests_, request);
}

std::optional<MemoryAnswer> MemoryModel::step() {
  ++now_;
  ++counts_.cycles;
  asked_ = false;
  if (!calendar_.empty()) reads_.take_all(requests_, calendar_[now_ & (calendar_.size() - 1)]);
  serve();
  const std::optional<MemoryAnswer> answered = answer();
  decide_ready();
  return answered;
}

/// Memory gives the next read, or begins to open its row.
void MemoryModel::serve() {
  if (now_ < memory_free_) return;
  if (opening_ == no_place) {
    if (reads_.empty() || requests_[reads_.first()].ready > now_) return;
    opening_ = reads_.pop(requests_);
    memory_free_ = now_ + (open_rows_.empty() ? 0 : cycles_of_row(requests_[opening_].block));
    if (now_ < memory_free_) return;
  }
  memory_free_ = now_ + read_cycles_;
  receive(std::exchange(opening_, no_place));
}

std::uint64_t MemoryModel::cycles_of_row(std::uint32_t block) {
  const DramRows& rows = options_.rows;
  const auto cycles = [](int count) { return static_cast<std::uint64_t>(count); };
  std::uint64_t taken = 0;
  if (rows.refresh_every > 0 && now_ >= next_refresh_) {
    next_refresh_ = now_ + cycles(rows.refresh_every);
    std::fill(open_rows_.begin(), open_rows_.end(), no_row);
    taken += cycles(rows.refresh_cycles);
  }
  const std::uint64_t row = block * ref::core_block_bytes / cycles(rows.row_bytes);
  const std::uint64_t bank = row % open_rows_.size();
  if (bank != std::exchange(last_bank_, bank)) taken += cycles(rows.bank_cycles);
  const std::uint64_t open = std::exchange(open_rows_[bank], row);
  if (open != row) taken += cycles(open == no_row ? rows.closed_cycles : rows.row_cycles);
  return taken;
}

void MemoryModel::receive(std::uint32_t read) {
  give(read);
  if (on_their_way_.empty()) return;
  Request& first = requests_[read];
  while (!first.merged.empty()) give(first.merged.pop(requests_));
  const std::uint32_t line = line_of(first.block);
  cache_.place(line);
  std::uint32_t* link = &on_their_way_[line % buckets];
  while (*link != read) link = &requests_[*link].next_of_bucket;
  *link = first.next_of_bucket;
}

void MemoryModel::give(std::uint32_t request) {
  requests_[request].ready = now_;
  requests_[request].given = true;
  if (!options_.in_order) received_.push(requests_, request);
}

/// Whether in_turn_ has the next answer.
bool MemoryModel::turn_is_first() const {
  if (in_turn_.empty()) return false;
  const Request& turn = requests_[in_turn_.first()];
  if (!turn.given || turn.ready > now_) return false;
  if (received_.empty()) return true;
  const Request& received = requests_[received_.first()];
  return turn.ready != received.ready ? turn.ready < received.ready : turn.number < received.number;
}

std::optional<MemoryAnswer> MemoryModel::answer() {
  LinkedQueue<Request>& queue = turn_is_first() ? in_turn_ : received_;
  std::optional<MemoryAnswer> answered;
  if (queue.empty()) return answered;
  const std::uint32_t place = queue.pop(requests_);
  const Request& request = requests_[place];
  MemoryAnswer& built = answered.emplace();
  built.tag = request.tag;
  built.number = request.block;
  if (request.block < blocks_.size()) built.block = blocks_[request.block];
  if (options_.error_percent > 0 && errors_.below(100) < static_cast<std::uint64_t>(options_.error_percent)) {
    built.error = true;
    // Of the right kind, or all right, so that nothing but the error tells.
    const std::size_t changed = errors_.coin() ? 0 : built.block.size() - 1;
    for (std::size_t word = 0; word < changed; ++word) built.block[word] ^= errors_.bits();
  }
  requests_.give_back(place);
  ++counts_.answers;
  --waiting_;
  return answered;
}

void MemoryModel::decide_ready() {
  ready_ = options_.most_waiting == 0 || waiting_ < static_cast<std::uint64_t>(options_.most_waiting);
  // Drawn in every cycle, so that the refused cycles do not depend on the requests.
  if (options_.refused_percent > 0 &&
      refusals_.below(100) < static_cast<std::uint64_t>(options_.refused_percent))
    ready_ = false;
}

}  // namespace hitpipe::sim
