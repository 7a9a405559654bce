#include "sim/core/core_bench.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "rtl_gen/graph/word.hpp"
#include "sim/cosim/run_rays.hpp"
#include "sw_ref/world/int_ray.hpp"

namespace hitpipe::sim {

namespace {

using rtl::Word;
using namespace hls::channels;

}  // namespace

std::vector<Word> ray_fields(const rtl::Core& core, const CoreJob& job) {
  const auto flag = [](bool is) -> Word { return is ? 1 : 0; };
  if (core.options.door == rtl::Door::binary32) {
    std::vector<Word> fields{flag(job.any)};
    for (const glm::vec3& vector : {job.ray.origin, job.ray.direction})
      for (int axis = 0; axis < 3; ++axis) fields.push_back(std::bit_cast<std::uint32_t>(vector[axis]));
    const float length = job.none ? std::numeric_limits<float>::quiet_NaN() : job.ray.length;
    fields.push_back(std::bit_cast<std::uint32_t>(length));
    return fields;
  }
  const hls::RayBits& bits = core.options.bits;
  const ref::IntRay ray = ref::int_ray(job.ray, bits.world());
  const ref::IntMajorRay box_ray = ref::major_ray(ray, bits.boxes());
  const auto m = static_cast<std::size_t>(box_ray.axes[0]), a = static_cast<std::size_t>(box_ray.axes[1]),
             b = static_cast<std::size_t>(box_ray.axes[2]);
  const auto origin = [&](std::size_t axis) {
    return static_cast<Word>(ray.origin[axis]) & rtl::ones_below(bits.point());
  };
  const auto slope = [&](std::size_t axis) { return static_cast<Word>(std::abs(ray.direction[axis])); };
  const ref::MajorQuotient &of_a = box_ray.quotient[0], &of_b = box_ray.quotient[1];
  return {flag(job.any),
          flag(job.none),
          flag(m == 1),
          flag(m == 2),
          flag(ray.negative[m]),
          flag(ray.negative[a]),
          flag(ray.negative[b]),
          origin(m),
          origin(a),
          origin(b),
          slope(a),
          slope(b),
          of_a.mantissa_low,
          of_a.mantissa_high,
          static_cast<Word>(of_a.exponent),
          of_b.mantissa_low,
          of_b.mantissa_high,
          static_cast<Word>(of_b.exponent),
          static_cast<Word>(ray.length)};
}

CoreCounts& CoreCounts::operator+=(const CoreCounts& later) {
  rays += later.rays;
  cycles += later.cycles;
  records += later.records;
  triangles += later.triangles;
  failed += later.failed;
  refused += later.refused;
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
  machine_.outputs(outputs_.data());
  machine_.step(inputs_.data(), true);
}

/// One to four fields have another bit, one or more bits in any place, or all below a place.
void CoreBench::spoil(std::vector<Word>& fields) {
  for (int left = random_.between(1, 4); left > 0; --left) {
    const std::size_t i = random_.below(fields.size());
    const int width = widths_[at_[ray_any] + i];
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

void CoreBench::let_more_rays() {
  Word& rays = inputs_[at_[most_rays]];
  if (counts_.cycles % 250 == 249) rays = std::min(2 * rays + 1, rtl::ones_below(widths_[at_[most_rays]]));
}

void CoreBench::show(const CoreJob& job) {
  std::vector<Word> fields = ray_fields(core_, job);
  const int wild = options_.wild_percent;
  if (wild > 0 && random_.below(100) < static_cast<std::uint64_t>(wild)) spoil(fields);
  std::copy(fields.begin(), fields.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(at_[ray_any]));
}

Word CoreBench::tag_of(std::size_t place, std::size_t places) {
  if (!options_.unruly) return place;
  const Word last = rtl::ones_below(core_.options.tag_bits);
  return place + places * (random_.bits() % ((last - place) / places + 1));
}

void CoreBench::check_alive(bool asks, bool asked, bool answers) {
  still_ = asks || answers ? 0 : still_ + 1;
  blocks_ = answers ? 0 : blocks_ + (asked ? 1 : 0);
  if (still_ > most_still_)
    throw std::logic_error(
        fmt::format("the core stands still: {} cycles without a request or an answer", still_));
  if (blocks_ > most_blocks_)
    throw std::logic_error(fmt::format(
        "the core gives no answer: it asked for {} blocks, more than its {} rays need in this scene", blocks_,
        core_.options.rays));
}

void CoreBench::take_block() {
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

CoreWeights CoreBench::weights() const {
  const hls::WorldBits world = core_.options.bits.world();
  const auto number = [&](auto halves, int width) {
    return rtl::number_of(outputs_[at_[halves.high]] << (width / 2) | outputs_[at_[halves.low]], width);
  };
  return {number(hls::weights::HitDet(), world.determinant()), number(hls::weights::HitU(), world.edge()),
          number(hls::weights::HitV(), world.edge())};
}

void CoreBench::count_idle(double room, double flying, double reading) {
  counts_.few_rays += (room - flying) / room;
  counts_.waiting += reading / room;
  counts_.inside += (flying - reading) / room;
}

class CoreBench::World {
 public:
  World(CoreBench& bench, std::span<const CoreJob> jobs, std::span<CoreAnswer> answers, std::size_t places)
      : bench_(bench), jobs_(jobs), answers_(answers), places_(places) {}

  void start(std::size_t tag, std::size_t job) { places_[tag] = {job, false}; }
  [[nodiscard]] bool done(std::size_t tag) const { return places_[tag].answered; }
  void ask(std::size_t tag) { waiting_.push_back(tag); }
  [[nodiscard]] bool idle() const { return waiting_.empty() && flying_ == 0; }
  template <class Answered>
  void cycle(const Answered& answered);

 private:
  struct Place {
    std::size_t job = 0;
    bool answered = true;
  };
  [[nodiscard]] Word out(std::size_t place) const { return bench_.outputs_[place]; }
  bool offer();
  bool request();
  std::optional<std::size_t> answer();

  CoreBench& bench_;
  std::span<const CoreJob> jobs_;
  std::span<CoreAnswer> answers_;
  std::vector<Place> places_;
  std::deque<std::size_t> waiting_;       ///< tags of rays that the core has not taken
  bool shown_ = false;                    ///< the first of them is at the ports
  std::size_t flying_ = 0, reading_ = 0;  ///< rays in the core, and those of them that wait for memory
};

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
    bench_.show(jobs_[places_[waiting_.front()].job]);
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
  const bool asks = out(at[request_valid]) != 0;
  const bool ready = bench_.memory_.ready();
  bench_.inputs_[at[request_ready]] = ready ? 1 : 0;
  if (!asks)
    bench_.count_idle(static_cast<double>(places_.size()), static_cast<double>(flying_),
                      static_cast<double>(reading_));
  else
    bench_.counts_.refused += ready ? 0 : 1;
  if (!asks || !ready) return false;
  const auto block = static_cast<std::uint64_t>(out(at[request_address]) / ref::core_block_bytes);
  const auto id = static_cast<std::uint32_t>(out(at[request_id]));
  // Addresses go round at their last bit.
  const auto mask = static_cast<std::uint64_t>(rtl::ones_below(bench_.core_.options.byte_bits - 5));
  bench_.memory_.ask(static_cast<std::uint32_t>((block - 2 * bench_.options_.base) & mask), id);
  ++reading_;
  ++((id >> bench_.core_.options.ray_bits()) != 0 ? bench_.counts_.triangles : bench_.counts_.records);
  return true;
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
  if (tag >= places_.size() || places_[tag].answered ||
      std::find(waiting_.begin(), waiting_.end(), tag) != waiting_.end())
    throw std::logic_error(
        fmt::format("the core answers a ray with the tag {}, which it does not have", tag));
  CoreAnswer& answer = answers_[places_[tag].job];
  answer = {.hit = {.triangle = static_cast<std::uint32_t>(out(at[Hits::number])),
                    .t = static_cast<std::int64_t>(out(at[Hits::t]))},
            .failed = static_cast<hls::Failure>(out(at[Hits::failed]))};
  if (bench_.core_.options.weights) answer.weights = bench_.weights();
  bench_.counts_.failed += answer.failed ? 1 : 0;
  places_[tag].answered = true;
  --flying_;
  return tag;
}

template <class Answered>
void CoreBench::World::cycle(const Answered& answered) {
  bench_.machine_.outputs(bench_.outputs_.data());
  if (bench_.options_.unruly) bench_.let_more_rays();
  const bool taken = offer();
  const bool asked = request();
  bench_.take_block();
  bench_.check_alive(out(bench_.at_[request_valid]) != 0, asked, out(bench_.at_[Hits::valid]) != 0);
  const std::optional<std::size_t> tag = answer();
  bench_.machine_.step(bench_.inputs_.data(), false);
  bench_.block_ = bench_.memory_.step();
  reading_ -= bench_.block_ ? 1 : 0;
  flying_ += taken ? 1 : 0;
  ++bench_.counts_.cycles;
  if (tag) answered(*tag);
}

void CoreBench::run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
                    const std::function<void(double)>& progress) {
  // A tag has few bits, so it is a place among the rays in flight.
  const auto rays = static_cast<Word>(core_.options.rays) * (options_.unruly ? 2 : 1);
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
