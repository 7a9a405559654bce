#include "sim/core/core_bench.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string_view>

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
    : core_(core),
      machine_(machine),
      options_(options),
      memory_(image.blocks, memory),
      at_(core),
      random_(options.seed) {
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
  for (const rtl::CorePort& port : core.ports) {
    (port.pin.is_input ? inputs_ : outputs_).push_back(0);
    if (port.pin.is_input) widths_.push_back(port.pin.width);
  }
  inputs_[at_[base]] = options.base;
  inputs_[at_[last]] = (options.blocks == 0 ? image.blocks.size() : options.blocks) - 1;
  inputs_[at_[most_steps]] = options.most_steps;
  inputs_[at_[most_rays]] =
      static_cast<Word>(options.unruly ? (core.options.rays + 3) / 4 : core.options.rays);
  if (core.bus.has_lines) {
    bus_.emplace(image.blocks, core.bus, options.unruly, options.seed);
    inputs_[at_[most_lines]] = static_cast<Word>(options.most_lines);
    inputs_[at_[lets_asks]] = 1;
  }
  if (at_.has(ray_begins)) {
    RingBusOptions rings{.unruly = options.unruly, .seed = options.seed};
    // A ray that cannot be read has another answer.
    if (options.wild_percent > 0) rings.error_percent = 2;
    rings_.emplace(core, rings);
    rings_->show(inputs_);
  }
  machine_.outputs(outputs_.data());
  machine_.step(inputs_.data(), true);
}

MemoryCounts CoreBench::memory_counts() const {
  MemoryCounts counts = memory_.counts();
  if (!bus_) return counts;
  counts.requests = counts_.records + counts_.triangles;
  counts.hits = counts_.hits;
  counts.misses = counts.requests - counts.hits;
  counts.merged = counts_.joins;
  return counts;
}

/// One to four fields have another bit, one or more bits in any place, or all below a place.
void CoreBench::spoil(std::vector<Word>& fields) {
  for (int left = random_.between(1, 4); left > 0; --left) {
    const std::size_t i = random_.below(fields.size());
    const int width = rings_ ? (i == 0 ? 1 : 32) : widths_[at_[ray_any] + i];
    const Word bit = Word{1} << random_.between(0, width - 1);
    switch (random_.between(0, 3)) {
      case 0:
        fields[i] ^= bit;
        break;
      case 1:
        fields[i] = random_.bits() & (2 * bit - 1);
        break;
      case 2:
        fields[i] = bit;
        break;
      default:
        fields[i] = bit - 1;
    }
  }
}

void CoreBench::put_random(std::size_t place, std::size_t count) {
  for (std::size_t i = place; i < place + count; ++i)
    inputs_[i] = random_.bits() & rtl::ones_below(widths_[i]);
}

void CoreBench::change_settings() {
  Word& rays = inputs_[at_[most_rays]];
  if (counts_.cycles % 250 == 249) rays = std::min(2 * rays + 1, rtl::ones_below(widths_[at_[most_rays]]));
  if (!bus_) return;
  // The cache is emptied, reads few lines or many, and rays ask for nothing for a while.
  inputs_[at_[empties_cache]] = random_.below(inputs_[at_[empties_cache]] != 0 ? 4 : 400) == 0 ? 1 : 0;
  if (random_.below(100) == 0) inputs_[at_[most_lines]] = Word{1} << random_.below(line_count_bits);
  if (random_.below(inputs_[at_[lets_asks]] == 0 ? 20 : 500) == 0) inputs_[at_[lets_asks]] ^= 1;
}

std::vector<Word> CoreBench::fields_of(const CoreJob& job) {
  std::vector<Word> fields = ray_fields(core_, job);
  const int wild = options_.wild_percent;
  if (wild == 0 || random_.below(100) >= static_cast<std::uint64_t>(wild)) return fields;
  spoil(fields);
  // The weights of a count mean nothing.
  if (has_questions(core_) && has_weights(core_)) fields[1] = 0;
  return fields;
}

Word CoreBench::tag_of(std::size_t place, std::size_t places) {
  if (!options_.unruly) return place;
  const Word last = rtl::ones_below(core_.options.tag_bits);
  return place + places * (random_.bits() % ((last - place) / places + 1));
}

void CoreBench::check_alive(bool asks, bool asked, bool answers) {
  still_ = asks || answers ? 0 : still_ + 1;
  blocks_ = answers ? 0 : blocks_ + (asked ? 1 : 0);
  if (still_ > most_still_ && !(rings_ && rings_->has_failed()))
    throw std::logic_error(
        fmt::format("the core stands still: {} cycles without a request or an answer", still_));
  if (blocks_ > most_blocks_)
    throw std::logic_error(fmt::format(
        "the core gives no answer: it asked for {} blocks, more than its {} rays need in this scene", blocks_,
        core_.options.rays));
}

void CoreBench::show_block() {
  inputs_[at_[read_valid]] = block_ ? 1 : 0;
  if (!block_) {
    if (options_.unruly) put_random(at_[read_id], 1 + BlockWords::count);
    return;
  }
  inputs_[at_[read_id]] = block_->tag;
  inputs_[at_[read_word_0]] = block_->block[0];
  inputs_[at_[read_word_1]] = block_->block[1];
  inputs_[at_[read_word_2]] = block_->block[2];
  inputs_[at_[read_word_3]] = block_->block[3];
  inputs_[at_[read_error]] = block_->error ? 1 : 0;
}

void CoreBench::show_beat() {
  const std::optional<BusBeat> beat = bus_->beat();
  inputs_[at_[beat_valid]] = beat ? 1 : 0;
  const auto lanes = static_cast<std::size_t>(core_.options.data_bits) / 64;
  if (!beat) {
    if (options_.unruly) {
      put_random(at_[beat_error], 1 + lanes);
      if (at_.has(hls::cache::beat_id)) put_random(at_[hls::cache::beat_id], 1);
    }
    return;
  }
  if (at_.has(hls::cache::beat_id)) inputs_[at_[hls::cache::beat_id]] = beat->id;
  inputs_[at_[beat_error]] = beat->error ? 1 : 0;
  std::copy_n(beat->words.begin(), lanes, inputs_.begin() + static_cast<std::ptrdiff_t>(at_[beat_0]));
}

CoreWeights CoreBench::weights() const {
  const hls::WorldBits world = core_.options.bits.world();
  const auto number = [&](auto halves, int width) {
    return rtl::number_of(outputs_[at_[halves.high]] << (width / 2) | outputs_[at_[halves.low]], width);
  };
  return {number(hls::weights::HitDet(), world.determinant()), number(hls::weights::HitU(), world.edge()),
          number(hls::weights::HitV(), world.edge())};
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
      : bench_(bench),
        jobs_(jobs),
        answers_(answers),
        places_(places),
        room_(static_cast<std::size_t>(bench.core_.options.rays)) {}

  void start(std::size_t tag, std::size_t job) { places_[tag] = {job, false}; }
  [[nodiscard]] bool done(std::size_t tag) const { return places_[tag].answered; }
  void ask(std::size_t tag) {
    waiting_.push_back(tag);
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
  [[nodiscard]] Word out(std::size_t place) const { return bench_.outputs_[place]; }
  bool offer();
  bool offer_in_memory();
  bool request();
  void request_line();
  void ask_memory();
  void read();
  void step_memory();
  std::optional<std::size_t> answer();
  std::optional<std::size_t> answer_in_memory();
  void take(std::size_t tag, const CoreAnswer& answer);

  CoreBench& bench_;
  std::span<const CoreJob> jobs_;
  std::span<CoreAnswer> answers_;
  std::vector<Place> places_;
  std::size_t room_;                      ///< of the core
  std::deque<std::size_t> waiting_;       ///< tags of rays that the core has not taken
  std::size_t unanswered_ = 0;            ///< these, and those that it has taken
  bool shown_ = false;                    ///< the first of them is at the ports
  std::size_t flying_ = 0, reading_ = 0;  ///< rays in the core, and those of them that wait for memory
};

/// A ray is written to memory. Says whether the core has begun another one.
bool CoreBench::World::offer_in_memory() {
  RingBus& rings = *bench_.rings_;
  const int gap = bench_.options_.gap_percent;
  if (!waiting_.empty() && rings.has_room() &&
      (gap == 0 || bench_.random_.below(100) >= static_cast<std::uint64_t>(gap))) {
    rings.offer(bench_.fields_of(jobs_[places_[waiting_.front()].job]),
                static_cast<std::uint32_t>(bench_.tag_of(waiting_.front(), places_.size())));
    waiting_.pop_front();
  }
  rings.show(bench_.inputs_);
  const bool begins = out(bench_.at_[ray_begins]) != 0;
  bench_.counts_.rays += begins ? 1 : 0;
  return begins;
}

/// Whether the core takes a ray.
bool CoreBench::World::offer() {
  const Places& at = bench_.at_;
  const int gap = bench_.options_.gap_percent;
  const bool waits =
      waiting_.empty() || (!shown_ && gap > 0 && bench_.random_.below(100) < static_cast<std::uint64_t>(gap));
  bench_.inputs_[at[ray_valid]] = waits ? 0 : 1;
  if (waits) {
    if (bench_.options_.unruly) bench_.put_random(at[ray_tag], at[Hits::ready] - at[ray_tag]);
    return false;
  }
  if (!shown_) {
    const std::vector<Word> fields = bench_.fields_of(jobs_[places_[waiting_.front()].job]);
    std::copy(fields.begin(), fields.end(),
              bench_.inputs_.begin() + static_cast<std::ptrdiff_t>(at[ray_any]));
    bench_.inputs_[at[ray_tag]] = bench_.tag_of(waiting_.front(), places_.size());
  }
  shown_ = out(at[ray_ready]) == 0;
  if (shown_) return false;
  waiting_.pop_front();
  ++bench_.counts_.rays;
  return true;
}

/// Whether memory takes a request.
bool CoreBench::World::request() {
  const Places& at = bench_.at_;
  const bool cached = bench_.bus_.has_value();
  const bool asks = out(cached ? at[hls::channels::asks] : at[request_valid]) != 0;
  const bool ready = cached ? out(at[granted]) != 0 : bench_.memory_.ready();
  if (cached)
    request_line();
  else
    bench_.inputs_[at[request_ready]] = ready ? 1 : 0;
  if (!asks)
    bench_.count_idle(std::min(static_cast<double>(places_.size()), static_cast<double>(room_)),
                      static_cast<double>(flying_), static_cast<double>(reading_));
  else
    bench_.counts_.refused += ready ? 0 : 1;
  if (!asks || !ready) return false;
  const auto id = static_cast<std::uint32_t>(out(at[request_id]));
  if (!cached) ask_memory();
  ++reading_;
  const bool of_triangle =
      cached ? out(at[asks_triangle]) != 0 : (id >> bench_.core_.options.ray_bits()) != 0;
  ++(of_triangle ? bench_.counts_.triangles : bench_.counts_.records);
  return true;
}

void CoreBench::World::request_line() {
  const Places& at = bench_.at_;
  const bool ready = bench_.memory_.ready();
  bench_.inputs_[at[request_ready]] = ready ? 1 : 0;
  if (ready && out(at[request_valid]) != 0) ask_memory();
  bench_.counts_.hits += out(at[cache_hit]) != 0 ? 1 : 0;
  bench_.counts_.joins += out(at[cache_join]) != 0 ? 1 : 0;
}

void CoreBench::World::ask_memory() {
  const Places& at = bench_.at_;
  const auto block = static_cast<std::uint64_t>(out(at[request_address]) / ref::core_block_bytes);
  // Addresses go round at their last bit.
  const auto mask = static_cast<std::uint64_t>(rtl::ones_below(bench_.core_.options.byte_bits - 5));
  bench_.memory_.ask(static_cast<std::uint32_t>((block - 2 * bench_.options_.base) & mask),
                     static_cast<std::uint32_t>(out(at[request_id])));
}

/// A block comes to its ray, or a beat to the core's cache.
void CoreBench::World::read() {
  const Places& at = bench_.at_;
  if (!bench_.bus_) {
    bench_.show_block();
    return;
  }
  bench_.show_beat();
  reading_ -= out(at[read_valid]) != 0 ? 1 : 0;
}

/// The tag of a ray that is answered.
std::optional<std::size_t> CoreBench::World::answer() {
  const Places& at = bench_.at_;
  const int held = bench_.options_.held_percent;
  const bool full = bench_.options_.unruly && bench_.counts_.cycles % 512 >= 384;
  const bool takes = !full && (held == 0 || bench_.random_.below(100) >= static_cast<std::uint64_t>(held));
  bench_.inputs_[at[Hits::ready]] = takes ? 1 : 0;
  if (!takes || out(at[Hits::valid]) == 0) return std::nullopt;
  const auto tag = static_cast<std::size_t>(out(at[Hits::tag]) % places_.size());
  CoreAnswer given{.hit = {.triangle = static_cast<std::uint32_t>(out(at[Hits::number])),
                           .t = static_cast<std::int64_t>(out(at[Hits::t]))},
                   .failed = static_cast<hls::Failure>(out(at[Hits::failed]))};
  if (has_weights(bench_.core_)) given.weights = bench_.weights();
  take(tag, given);
  --flying_;
  return tag;
}

/// The same of an answer that is in memory.
std::optional<std::size_t> CoreBench::World::answer_in_memory() {
  const Places& at = bench_.at_;
  if (out(at[Hits::valid]) != 0 && out(at[Hits::ready]) != 0) --flying_;
  const std::optional<RingAnswer> found = bench_.rings_->take();
  if (!found) return std::nullopt;
  const std::size_t tag = found->tag % places_.size();
  take(tag, {.hit = {.triangle = found->number, .t = found->t},
             .failed = static_cast<hls::Failure>(found->failed)});
  return tag;
}

void CoreBench::World::take(std::size_t tag, const CoreAnswer& answer) {
  if (tag >= places_.size() || places_[tag].answered ||
      std::find(waiting_.begin(), waiting_.end(), tag) != waiting_.end())
    throw std::logic_error(
        fmt::format("the core answers a ray with the tag {}, which it does not have", tag));
  answers_[places_[tag].job] = answer;
  bench_.counts_.failed += answer.failed ? 1 : 0;
  places_[tag].answered = true;
  --unanswered_;
}

void CoreBench::World::step_memory() {
  const Places& at = bench_.at_;
  if (bench_.bus_) {
    bench_.bus_->step(bench_.inputs_[at[beat_valid]] != 0 && out(at[beat_ready]) != 0);
    if (const std::optional<MemoryAnswer> line = bench_.memory_.step()) bench_.bus_->take(*line);
    return;
  }
  bench_.block_ = bench_.memory_.step();
  reading_ -= bench_.block_ ? 1 : 0;
}

template <class Answered>
void CoreBench::World::cycle(const Answered& answered) {
  bench_.machine_.outputs(bench_.outputs_.data());
  if (bench_.options_.unruly) bench_.change_settings();
  const bool has_rings = bench_.rings_.has_value();
  const bool taken = has_rings ? offer_in_memory() : offer();
  const bool asked = request();
  read();
  bench_.check_alive(asked || out(bench_.at_[request_valid]) != 0, asked, out(bench_.at_[Hits::valid]) != 0);
  const std::optional<std::size_t> tag = has_rings ? answer_in_memory() : answer();
  if (has_rings) bench_.rings_->step(bench_.inputs_, bench_.outputs_);
  bench_.machine_.step(bench_.inputs_.data(), false);
  step_memory();
  flying_ += taken ? 1 : 0;
  ++bench_.counts_.cycles;
  if (tag) answered(*tag);
}

void CoreBench::run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
                    const std::function<void(double)>& progress) {
  // A tag has few bits, so it is a place among the rays in flight.
  Word rays = static_cast<Word>(core_.options.rays) * (options_.unruly ? 2 : 1);
  // As many again wait in the rings.
  if (rings_) rays = 2 * rays + 64;
  const auto places = static_cast<std::size_t>(std::min(rtl::ones_below(core_.options.tag_bits) + 1, rays));
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
