#include "sim/core/core_bench.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/graph/word.hpp"
#include "sim/cosim/run_rays.hpp"

namespace hitpipe::sim {

namespace {

using rtl::Word;
using namespace hls::channels;

}  // namespace

CoreCounts& CoreCounts::operator+=(const CoreCounts& later) {
  rays += later.rays;
  cycles += later.cycles;
  records += later.records;
  triangles += later.triangles;
  failed += later.failed;
  refused += later.refused;
  hits += later.hits;
  joins += later.joins;
  few_rays += later.few_rays;
  waiting += later.waiting;
  inside += later.inside;
  return *this;
}

CoreBench::CoreBench(const rtl::Core& core, rtl::NativeMachine& machine, const ref::CoreImage& image,
                     const MemoryOptions& memory, const CoreBenchOptions& options)
    : machine_(machine), pins_(core, options) {
  // A block that was read waits for the tests of all other rays' blocks; one multiplier takes some 200 cycles
  // a triangle.
  constexpr std::uint64_t cycles_of_a_test = 1000;
  const auto rays = static_cast<std::uint64_t>(core.options.rays);
  most_still_ = static_cast<std::uint64_t>(memory.most_latency) +
                rays * (static_cast<std::uint64_t>(std::max(memory.interval, memory.line_interval)) +
                        cycles_of_a_test) +
                10'000;
  // A ray tests a triangle once, and can come to a record again from each level above it. In a damaged image
  // it may come more often, until its steps are used up.
  constexpr std::uint64_t room = 10;
  const std::uint64_t blocks =
      std::uint64_t{image.records} * static_cast<std::uint64_t>(image.header.levels) + image.header.triangles;
  most_blocks_ = room * rays * (blocks + 100);
  const std::uint64_t most_blocks = std::uint64_t{1} << core.options.address_bits;
  if (image.blocks.size() > most_blocks)
    throw std::invalid_argument(fmt::format("the image has {} blocks, but the core reads {} at most",
                                            image.blocks.size(), most_blocks));
  pins_.in(base) = options.base;
  pins_.in(last) = (options.blocks == 0 ? image.blocks.size() : options.blocks) - 1;
  pins_.in(most_steps) = options.most_steps;
  pins_.in(most_rays) = static_cast<Word>(options.unruly ? (core.options.rays + 3) / 4 : core.options.rays);
  blocks_ = make_block_port(pins_, image, memory);
  rays_ = make_ray_port(pins_);
  machine_.outputs(pins_.outputs.data());
  machine_.step(pins_.inputs.data(), true);
}

CoreCounts CoreBench::counts() const {
  CoreCounts counts = counts_;
  counts.cycles = pins_.cycles;
  counts.hits = blocks_->hits;
  counts.joins = blocks_->joins;
  return counts;
}

MemoryCounts CoreBench::memory_counts() const {
  MemoryCounts counts = blocks_->memory().counts();
  if (!pins_.core.bus.has_lines) return counts;
  counts.requests = counts_.records + counts_.triangles;
  counts.hits = blocks_->hits;
  counts.misses = counts.requests - counts.hits;
  counts.merged = blocks_->joins;
  return counts;
}

void CoreBench::check_alive(bool asks, bool asked, bool answers) {
  still_ = asks || answers ? 0 : still_ + 1;
  read_since_ = answers ? 0 : read_since_ + (asked ? 1 : 0);
  if (still_ > most_still_ && !rays_->has_failed())
    throw std::logic_error(
        fmt::format("the core stands still: {} cycles without a request or an answer", still_));
  if (read_since_ > most_blocks_)
    throw std::logic_error(fmt::format(
        "the core gives no answer: it asked for {} blocks, more than its {} rays need in this scene",
        read_since_, pins_.core.options.rays));
}

void CoreBench::count_idle(double room, double begun, double reading) {
  // Some rays wait in front of the door.
  const double flying = std::min(begun, room);
  counts_.few_rays += (room - flying) / room;
  counts_.waiting += reading / room;
  counts_.inside += (flying - reading) / room;
}

class CoreBench::World {
 public:
  World(CoreBench& bench, std::span<const CoreJob> jobs, std::span<CoreAnswer> answers, std::size_t places)
      : bench_(bench), jobs_(jobs), answers_(answers), places_(places) {
    bench_.rays_->tags(places);
  }

  void start(std::size_t tag, std::size_t job) { places_[tag] = {job, false}; }
  [[nodiscard]] bool done(std::size_t tag) const { return places_[tag].answered; }
  void ask(std::size_t tag) {
    bench_.rays_->push({&jobs_[places_[tag].job], tag});
    ++unanswered_;
  }
  [[nodiscard]] bool idle() const { return unanswered_ == 0; }
  template <class Answered>
  void cycle(const Answered& answered);

 private:
  struct Place {
    std::size_t job = 0;
    bool answered = true;
  };
  bool request();
  void take(const RayPort::Answer& given);

  CoreBench& bench_;
  std::span<const CoreJob> jobs_;
  std::span<CoreAnswer> answers_;
  std::vector<Place> places_;
  std::size_t unanswered_ = 0;            ///< rays that wait for the core, and those that it has taken
  std::size_t flying_ = 0, reading_ = 0;  ///< rays in the core, and those of them that wait for memory
};

/// Whether memory takes a request.
bool CoreBench::World::request() {
  CoreCounts& counts = bench_.counts_;
  const BlockPort::Request request = bench_.blocks_->request();
  if (!request.asks)
    bench_.count_idle(static_cast<double>(
                          std::min(places_.size(), static_cast<std::size_t>(bench_.pins_.core.options.rays))),
                      static_cast<double>(flying_), static_cast<double>(reading_));
  else
    counts.refused += request.granted ? 0 : 1;
  if (!request.granted) return false;
  ++reading_;
  ++(request.of_triangle ? counts.triangles : counts.records);
  return true;
}

void CoreBench::World::take(const RayPort::Answer& given) {
  const std::size_t tag = given.tag;
  if (tag >= places_.size() || places_[tag].answered || bench_.rays_->waits(tag))
    throw std::logic_error(
        fmt::format("the core answers a ray with the tag {}, which it does not have", tag));
  answers_[places_[tag].job] = given.answer;
  bench_.counts_.failed += given.answer.failed ? 1 : 0;
  places_[tag].answered = true;
  --unanswered_;
}

template <class Answered>
void CoreBench::World::cycle(const Answered& answered) {
  CorePins& pins = bench_.pins_;
  bench_.machine_.outputs(pins.outputs.data());
  if (pins.options.unruly) {
    Word& rays = pins.in(most_rays);
    if (pins.cycles % 250 == 249)
      rays = std::min(2 * rays + 1, rtl::ones_below(pins.widths[pins.at[most_rays]]));
    bench_.blocks_->change_settings();
  }
  const bool begun = bench_.rays_->offer();
  const bool asked = request();
  bench_.blocks_->show();
  bench_.check_alive(asked || pins.out(request_valid) != 0, asked, pins.out(Hits::valid) != 0);
  const std::optional<RayPort::Answer> given = bench_.rays_->answer();
  if (bench_.rays_->gives()) --flying_;
  if (given) take(*given);
  bench_.rays_->end();
  bench_.machine_.step(pins.inputs.data(), false);
  if (bench_.blocks_->end()) --reading_;
  flying_ += begun ? 1 : 0;
  bench_.counts_.rays += begun ? 1 : 0;
  ++pins.cycles;
  if (given) answered(given->tag);
}

void CoreBench::run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
                    const std::function<void(double)>& progress) {
  // A tag has few bits, so it is a place among the rays in flight.
  const auto places =
      static_cast<std::size_t>(std::min(rtl::ones_below(pins_.core.options.tag_bits) + 1, rays_->room()));
  World world(*this, jobs, answers, places);
  std::size_t next = 0, ended = 0;
  run_rays(
      world, places, [&] { return next < jobs.size() ? std::optional(next++) : std::nullopt; },
      [&](std::size_t) {
        if (++ended % 4096 == 0 && progress)
          progress(static_cast<double>(ended) / static_cast<double>(jobs.size()));
      });
}

}  // namespace hitpipe::sim
