// The ports of a core, with what a bench gives them and draws at random.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hls/machines/cache.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/weights.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/graph/word.hpp"
#include "sim/core/port_places.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

struct CoreBenchOptions {
  std::uint32_t most_steps = (1U << 20) - 1;  ///< records that a ray may test, 1 or more
  std::uint64_t base = 0;                     ///< the image's address, divided by 64
  int held_percent = 0;                       ///< of all cycles take no answer, at random, 0..99
  int gap_percent = 0;                        ///< of all cycles begin to offer no ray, at random, 0..99
  std::uint64_t blocks = 0;                   ///< that the image is said to have; 0: as many as it has
  int wild_percent = 0;                       ///< of all rays have other numbers in some fields, 0..100
  /// Twice as many rays are offered as the core has room for, with any tags; most_rays grows from few to its largest
  /// number; answers wait for long; and ports have random words while they say nothing.
  bool unruly = false;
  int most_lines = 8;  ///< that a core with a cache reads at a time, 1..63
  std::uint64_t seed = 1;
};

struct CorePins {
  /// The core must outlive it.
  CorePins(const rtl::Core& of, const CoreBenchOptions& options_of_bench)
      : core(of), options(options_of_bench), at(of), random(options_of_bench.seed) {
    for (const rtl::CorePort& port : core.ports) {
      (port.pin.is_input ? inputs : outputs).push_back(0);
      if (port.pin.is_input) widths.push_back(port.pin.width);
    }
  }

  template <class Field>
  [[nodiscard]] rtl::Word& in(Field field) {
    return inputs[at[field]];
  }
  template <class Field>
  [[nodiscard]] rtl::Word out(Field field) const {
    return outputs[at[field]];
  }
  /// Of some percent of all calls.
  [[nodiscard]] bool happens(int percent) {
    return percent > 0 && random.below(100) < static_cast<std::uint64_t>(percent);
  }
  /// Random words in so many inputs.
  void put_random(std::size_t place, std::size_t count) {
    for (std::size_t i = place; i < place + count; ++i)
      inputs[i] = random.bits() & rtl::ones_below(widths[i]);
  }
  /// The words in the inputs from a place on.
  void put(std::size_t place, const std::vector<rtl::Word>& words) {
    std::ranges::copy(words, inputs.begin() + static_cast<std::ptrdiff_t>(place));
  }

  using OfCache =
      hls::Join<hls::List<hls::channels::asks, hls::channels::asks_triangle>, hls::channels::Asks::Back,
                hls::channels::Beat, hls::channels::Beat::Back, hls::List<hls::cache::beat_id>,
                hls::channels::CacheSettings, hls::channels::CacheEvents>;
  using Places =
      PortPlaces<hls::Join<hls::List<hls::channels::ray_valid, hls::channels::ray_ready,
                                     hls::channels::ray_tag, hls::channels::ray_any>,
                           hls::channels::Hits, hls::channels::Hits::Back, hls::channels::Request,
                           hls::channels::Request::Back, hls::channels::BlockRead, hls::channels::Settings,
                           hls::weights::HitWeights, OfCache, hls::List<hls::channels::ray_begins>>>;

  const rtl::Core& core;
  CoreBenchOptions options;
  Places at;
  ref::adversary::Random random;
  std::vector<rtl::Word> inputs, outputs;
  std::vector<int> widths;   ///< of the inputs
  std::uint64_t cycles = 0;  ///< that have ended
};

}  // namespace hitpipe::sim
