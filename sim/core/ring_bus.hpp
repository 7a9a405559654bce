// The memory with the two rings of a core that reads rays from memory (hls/machines/rings.hpp), and the host that
// fills the one and empties the other, cycle by cycle. The port to it is its own: it takes nothing from the memory of
// the blocks.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hls/machines/rings.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "sim/core/port_places.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

struct RingBusOptions {
  int latency =
      20;  ///< cycles from a request to its first beat, and from the last beat to its answer, 1 or more
  /// Requests are refused, beats have gaps, latencies differ, at random. After some time an answer cannot be written.
  bool unruly = false;
  int error_percent = 0;  ///< of all bursts, 0..100
  std::uint64_t seed = 1;
};

struct RingAnswer {
  std::uint32_t tag = 0, number = 0;
  int failed = 0;
  std::int64_t t = 0;
};

class RingBus {
 public:
  static constexpr std::uint64_t most_places = 256;  ///< of each ring

  /// The core must outlive it.
  RingBus(const rtl::Core& core, const RingBusOptions& options);

  /// Whether another ray has room: the answers of fewer rays than a ring has places are still to be taken.
  [[nodiscard]] bool has_room() const { return on_their_way_ < rays_.size(); }
  /// A ray is written behind the others. `fields` are those of ray_fields().
  void offer(std::span<const rtl::Word> fields, std::uint32_t tag);
  /// Sets the inputs of a cycle.
  void show(std::span<rtl::Word> inputs);
  /// Its end. Inputs and outputs are the core's.
  void step(std::span<const rtl::Word> inputs, std::span<const rtl::Word> outputs);
  /// The oldest answer that the host has not taken.
  [[nodiscard]] std::optional<RingAnswer> take();
  /// An answer could not be written, so the core stands still.
  [[nodiscard]] bool has_failed() const { return failed_; }

 private:
  static constexpr std::uint64_t calm_cycles = 700;
  using Words = std::array<std::uint64_t, 4>;
  struct Read {
    std::uint64_t place;  ///< of the first 8 bytes, in words of 8
    int words;            ///< that are to come
    std::uint64_t due;
    bool error;
  };
  using Places = PortPlaces<hls::Join<hls::channels::RingSettings, hls::rings::Fetch, hls::rings::Fetch::Back,
                                      hls::rings::Store, hls::rings::Store::Back, hls::channels::RingState>>;
  [[nodiscard]] bool one_in(std::uint64_t count) { return options_.unruly && random_.below(count) == 0; }
  [[nodiscard]] std::uint64_t latency();

  const rtl::Core& core_;
  RingBusOptions options_;
  Places at_;
  ref::adversary::Random random_;
  std::size_t beat_words_;
  rtl::Word rays_at_, answers_at_;  ///< addresses divided by 128
  std::vector<Words> rays_;
  std::vector<std::array<std::uint64_t, 2>> answers_;
  std::uint64_t offered_ = 0, taken_ = 0, in_memory_ = 0, cycle_ = 0;
  std::uint64_t on_their_way_ = 0;
  std::deque<Read> reads_;
  bool shown_ = false;  ///< a beat
  bool failed_ = false;
  std::optional<std::uint64_t> store_at_;  ///< where what is put goes, in words of 8
  std::vector<std::uint64_t> put_;
  bool put_all_ = false;
  std::optional<std::uint64_t> stored_due_;  ///< when the core is told
};

}  // namespace hitpipe::sim
