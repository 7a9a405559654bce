// The memory that a traversal core reads (docs/core.md), cycle by cycle: latency, order, bandwidth, refused
// requests and a cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rays/image/core_image.hpp"
#include "sim/core/linked_queue.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/memory/line_cache.hpp"

namespace hitpipe::sim {

/// The rows of a DRAM, in cycles. A read has to wait when it comes to another bank than the read before, and when its
/// row is not open. A refresh stops all reads and closes all rows.
struct DramRows {
  int row_bytes = 0;  ///< 0: there are no rows, else a power of two, 64..65,536
  int banks = 1;      ///< a power of two, 1..64; row after row is in the next one
  int bank_cycles = 0, closed_cycles = 0,
      row_cycles = 0;                         ///< another bank; no row is open; another row is open
  int refresh_every = 0, refresh_cycles = 0;  ///< 0: never
};

/// All times are in cycles.
struct MemoryOptions {
  /// From a request to its answer, when nothing else waits. 1..most_cycles, drawn for each read.
  int least_latency = 100, most_latency = 100;
  bool in_order = false;  ///< answers in the order of their requests; else each when it is ready
  bool reads_lines =
      false;              ///< a request is one for a line, which the core's own cache wants; else for a block
  int interval = 1;       ///< for each block that memory gives without a cache, 1..most_cycles
  int line_interval = 2;  ///< for each line that memory gives to a cache, 1..most_cycles
  int line_bytes = 64;    ///< of the core's own cache: 32, 64; those of the cache in this model are 64
  DramRows rows{};
  int refused_percent = 0;  ///< of all cycles refuse a request, at random, 0..99
  int error_percent = 0;    ///< of all answers are errors, with other words than the block's, 0..99
  int most_waiting = 0;     ///< requests on their way; 0: no limit
  int cache_kib = 0;        ///< of a cache in this model; 0: none, else a power of two, 1..most_cache_kib
  int hit_latency = 4;      ///< of a request whose line is in the cache, 1..most_cycles
  std::uint64_t seed = 1;

  static constexpr int most_cycles = 10'000;
  static constexpr int most_cache_kib = 65'536;
};

struct MemoryCounts {
  std::uint64_t cycles = 0;
  std::uint64_t requests = 0;
  std::uint64_t outside = 0;       ///< requests for a block that the image does not have
  std::uint64_t hits = 0;          ///< requests whose line was in the cache
  std::uint64_t misses = 0;        ///< all others
  std::uint64_t merged = 0;        ///< misses whose line was on its way
  std::uint64_t bytes_read = 0;    ///< from memory
  std::uint64_t answers = 0;       ///< cycles in which the port answered
  std::uint64_t most_waiting = 0;  ///< requests on their way at a time

  /// Adds up the counts; of most_waiting takes the larger.
  MemoryCounts& operator+=(const MemoryCounts& later);
  friend bool operator==(const MemoryCounts&, const MemoryCounts&) = default;
};

struct MemoryAnswer {
  std::uint32_t tag = 0;
  std::uint32_t number = 0;  ///< of the block, of a line the first
  ref::CoreBlock block{};
  bool error = false;
  friend bool operator==(const MemoryAnswer&, const MemoryAnswer&) = default;
};

/// In a cycle the core may ask once if the memory is ready; step() ends the cycle. A request that is taken in
/// cycle c with latency n is answered in cycle c + n or later: in that cycle the core sees the answer. There
/// is at most one answer in a cycle, the one that was ready first, and of two the older request.
///
/// Memory gives one block in `interval` cycles, with a cache one line in `line_interval`, and later by what rows take.
/// It gives first what is ready first, or with in_order what was asked for first. A line enters the cache when
/// memory gives it, and all requests that wait for it are then ready. A hit takes no time of the memory.
///
/// Behind the image's end all blocks are zero; to a cache they are one line. The same options and requests
/// give the same answers in the same cycles, on every machine.
class MemoryModel {
 public:
  /// `blocks` must outlive the model. Throws std::invalid_argument, one line, for an option that is not
  /// allowed.
  MemoryModel(std::span<const ref::CoreBlock> blocks, const MemoryOptions& options);

  /// Whether it takes a request in this cycle; the same from one step to the next.
  [[nodiscard]] bool ready() const { return ready_; }
  /// Throws std::logic_error when it is not ready, or was asked in this cycle before.
  void ask(std::uint32_t block, std::uint32_t tag);
  /// One edge of the clock: gives the answer that the core sees in the cycle behind it.
  std::optional<MemoryAnswer> step();

  /// Requests that were taken and not answered.
  [[nodiscard]] std::uint64_t waiting() const { return waiting_; }
  [[nodiscard]] const MemoryCounts& counts() const { return counts_; }

 private:
  static constexpr std::size_t buckets = 4096;

  /// A read of memory is the first request that waits for it.
  struct Request {
    std::uint32_t block, tag;
    std::uint64_t number;  ///< requests before it
    /// The first cycle in which memory can give it; when it is given, in which it can be answered.
    std::uint64_t ready = 0;
    bool given = false;                       ///< by memory or the cache
    std::uint32_t next = no_place;            ///< to be answered
    std::uint32_t next_read = no_place;       ///< to be given, or in `merged`
    std::uint32_t next_of_bucket = no_place;  ///< on its way
    using Reads = LinkedQueue<Request, &Request::next_read>;
    Reads merged{};  ///< the others that wait for this read
  };
  using Reads = Request::Reads;

  [[nodiscard]] std::uint32_t line_of(std::uint32_t block) const;
  bool merge(std::uint32_t request);
  void read(std::uint32_t request);
  void serve();
  void receive(std::uint32_t read);
  std::uint64_t cycles_of_row(std::uint32_t block);
  void give(std::uint32_t request);
  [[nodiscard]] bool turn_is_first() const;
  std::optional<MemoryAnswer> answer();
  void decide_ready();

  std::span<const ref::CoreBlock> blocks_;
  MemoryOptions options_;
  std::uint64_t read_bytes_, read_cycles_;  ///< of a block, or of a line of the cache
  ref::adversary::Random latencies_, refusals_, errors_;
  ref::LineCache cache_;
  MemoryCounts counts_;

  NodePool<Request> requests_;
  LinkedQueue<Request> in_turn_;   ///< hits; with in_order all requests
  LinkedQueue<Request> received_;  ///< what memory has given, without in_order
  Reads reads_;                    ///< the next that memory gives is the first
  /// Slot c modulo their number has the reads that are ready in cycle c, and go to reads_ then. Without slots
  /// all go there at once: they are ready, or to be given, in the order of their requests.
  std::vector<Reads> calendar_;
  std::vector<std::uint32_t> on_their_way_;  ///< with a cache: the newest read of each bucket of lines

  std::uint64_t now_ = 0;
  std::uint64_t memory_free_ = 0;         ///< the first cycle in which memory can give a read
  std::uint32_t opening_ = no_place;      ///< a read whose row is being opened, until memory_free_
  std::vector<std::uint64_t> open_rows_;  ///< of each bank
  std::uint64_t last_bank_ = 0, next_refresh_ = 0;
  std::uint64_t waiting_ = 0;
  bool ready_ = true;
  bool asked_ = false;  ///< in this cycle
};

}  // namespace hitpipe::sim
