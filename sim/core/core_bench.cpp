#include "sim/core/core_bench.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "rtl_gen/graph/word.hpp"
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
    fields.push_back(std::bit_cast<std::uint32_t>(job.ray.length));
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
          flag(false),  // no error
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
                rays * (static_cast<std::uint64_t>(memory.interval) * 2 + cycles_of_a_test) + 10'000;
  // A ray tests a triangle once, and can come to a record again from each level above it. In a damaged image
  // it may come more often, until its steps are used up.
  constexpr std::uint64_t room = 10;
  const std::uint64_t blocks =
      std::uint64_t{image.records} * static_cast<std::uint64_t>(image.levels) + image.triangles;
  most_blocks_ = room * rays * (blocks + 100);
  const std::uint64_t most_blocks = std::uint64_t{1} << core.options.address_bits;
  if (image.blocks.size() > most_blocks)
    throw std::invalid_argument(fmt::format("the image has {} blocks, but the core reads {} at most",
                                            image.blocks.size(), most_blocks));
  for (const rtl::CorePort& port : core.ports) {
    (port.pin.is_input ? inputs_ : outputs_).push_back(0);
  }
  inputs_[at_[base]] = options.base;
  inputs_[at_[last]] = image.blocks.size() - 1;
  inputs_[at_[most_steps]] = options.most_steps;
  inputs_[at_[most_rays]] = static_cast<Word>(core.options.rays);
  machine_.outputs(outputs_.data());
  machine_.step(inputs_.data(), true);
}

void CoreBench::show(const CoreJob& job, std::size_t tag) {
  const std::vector<Word> fields = ray_fields(core_, job);
  std::copy(fields.begin(), fields.end(), inputs_.begin() + static_cast<std::ptrdiff_t>(at_[ray_any]));
  inputs_[at_[ray_tag]] = tag;
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
  if (!block_) return;
  inputs_[at_[read_id]] = block_->tag;
  inputs_[at_[read_word_0]] = block_->block[0];
  inputs_[at_[read_word_1]] = block_->block[1];
  inputs_[at_[read_word_2]] = block_->block[2];
  inputs_[at_[read_word_3]] = block_->block[3];
}

CoreWeights CoreBench::weights() const {
  const hls::WorldBits world = core_.options.bits.world();
  const auto number = [&](auto halves, int width) {
    return rtl::number_of(outputs_[at_[halves.high]] << (width / 2) | outputs_[at_[halves.low]], width);
  };
  return {number(hls::weights::HitDet(), world.determinant()), number(hls::weights::HitU(), world.edge()),
          number(hls::weights::HitV(), world.edge())};
}

void CoreBench::run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
                    const std::function<void(double)>& progress) {
  constexpr std::size_t nothing = ~std::size_t{0};
  // A tag has few bits, so it is a place among the jobs in flight.
  const Word tags = rtl::ones_below(core_.options.tag_bits) + 1;
  std::vector<std::size_t> in_flight(
      static_cast<std::size_t>(std::min(tags, static_cast<Word>(core_.options.rays))), nothing);
  std::vector<std::size_t> free_tags;
  for (std::size_t tag = in_flight.size(); tag-- > 0;) free_tags.push_back(tag);
  const auto block_mask = static_cast<std::uint64_t>(rtl::ones_below(core_.options.byte_bits - 5));
  std::size_t next = 0, ended = 0, offered = nothing;  // the tag of the job `next`
  std::size_t flying = 0, reading = 0;  // rays in flight, and those of them that wait for memory
  while (ended < jobs.size()) {
    machine_.outputs(outputs_.data());
    const auto out = [&](std::size_t place) { return outputs_[place]; };

    if (offered == nothing && next < jobs.size() && !free_tags.empty()) {
      offered = free_tags.back();
      free_tags.pop_back();
      show(jobs[next], offered);
    }
    bool accepts = false;
    inputs_[at_[ray_valid]] = offered != nothing ? 1 : 0;
    if (offered != nothing && out(at_[ray_ready]) != 0) {
      in_flight[offered] = next++;
      offered = nothing;
      accepts = true;
      ++counts_.rays;
    }

    const bool asks = out(at_[request_valid]) != 0;
    const bool ready = memory_.ready();
    inputs_[at_[request_ready]] = ready ? 1 : 0;
    if (asks) {
      counts_.refused += ready ? 0 : 1;
    } else {
      const auto room = static_cast<double>(in_flight.size());
      counts_.few_rays += static_cast<double>(in_flight.size() - flying) / room;
      counts_.waiting += static_cast<double>(reading) / room;
      counts_.inside += static_cast<double>(flying - reading) / room;
    }
    if (asks && ready) {
      const auto block = static_cast<std::uint64_t>(out(at_[request_address]) / ref::core_block_bytes);
      const auto id = static_cast<std::uint32_t>(out(at_[request_id]));
      // Addresses go round at their last bit.
      memory_.ask(static_cast<std::uint32_t>((block - options_.base) & block_mask), id);
      ++reading;
      ++((id >> core_.options.ray_bits()) != 0 ? counts_.triangles : counts_.records);
    }
    take_block();

    const bool takes =
        options_.held_percent == 0 || random_.below(100) >= static_cast<std::uint64_t>(options_.held_percent);
    inputs_[at_[Hits::ready]] = takes ? 1 : 0;
    check_alive(asks, asks && ready, out(at_[Hits::valid]) != 0);
    if (takes && out(at_[Hits::valid]) != 0) {
      const auto tag = static_cast<std::size_t>(out(at_[Hits::tag]));
      if (tag >= in_flight.size() || in_flight[tag] == nothing)
        throw std::logic_error(
            fmt::format("the core answers a ray with the tag {}, which it does not have", tag));
      CoreAnswer& answer = answers[in_flight[tag]];
      answer = {.hit = {.triangle = static_cast<std::uint32_t>(out(at_[Hits::number])),
                        .t = static_cast<std::int64_t>(out(at_[Hits::t]))},
                .failed = out(at_[Hits::failed]) != 0};
      if (core_.options.weights) answer.weights = weights();
      counts_.failed += answer.failed ? 1 : 0;
      in_flight[tag] = nothing;
      --flying;
      free_tags.push_back(tag);
      ++ended;
      if (progress && ended % 4096 == 0)
        progress(static_cast<double>(ended) / static_cast<double>(jobs.size()));
    }
    machine_.step(inputs_.data(), false);
    block_ = memory_.step();
    reading -= block_ ? 1 : 0;
    flying += accepts ? 1 : 0;
    ++counts_.cycles;
  }
}

}  // namespace hitpipe::sim
