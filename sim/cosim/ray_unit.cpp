#include "sim/cosim/ray_unit.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/judge/box_referee.hpp"

namespace hitpipe::sim {

/// The slots whose rays can send a test, in the order in which they became ready. Each is in it once at most.
class SlotQueue {
 public:
  explicit SlotQueue(std::size_t slots) : ring_(slots) {}

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t front() const { return ring_[front_]; }
  void push(std::size_t slot) {
    const std::size_t end = front_ + count_++;
    ring_[end < ring_.size() ? end : end - ring_.size()] = slot;
  }
  void pop() {
    --count_;
    if (++front_ == ring_.size()) front_ = 0;
  }

 private:
  std::vector<std::size_t> ring_;
  std::size_t front_ = 0;
  std::size_t count_ = 0;
};

namespace {

void add(std::optional<std::uint64_t>& sum, const std::optional<std::uint64_t>& count) {
  if (sum && count) {
    *sum += *count;
  } else {
    sum.reset();
  }
}

const RayUnit::Options& checked(const RayUnit::Options& options) {
  if (options.rays_in_flight < 1 || options.rays_in_flight > RayUnit::most_rays_in_flight)
    throw std::invalid_argument(fmt::format("{} rays in flight: allowed is 1 to {}", options.rays_in_flight,
                                            RayUnit::most_rays_in_flight));
  if (const auto& slots = options.verilated->unit().ray_slots)
    check_slots(options.rays_in_flight, slots->slots());
  return options;
}

}  // namespace

void check_slots(int rays_in_flight, int slots) {
  if (rays_in_flight > slots)
    throw std::invalid_argument(fmt::format(
        "{} rays in flight: each needs a slot, and there are {} ray slots", rays_in_flight, slots));
}

UnitCounts UnitCounts::zeros(bool referee) {
  UnitCounts counts;
  if (referee) counts.false_misses = counts.false_hits = 0;
  return counts;
}

UnitCounts& UnitCounts::operator+=(const UnitCounts& other) {
  tests += other.tests;
  box_tests += other.box_tests;
  triangle_tests += other.triangle_tests;
  hits += other.hits;
  rtl_mismatches += other.rtl_mismatches;
  add(false_misses, other.false_misses);
  add(false_hits, other.false_hits);
  cycles += other.cycles;
  ray_writes += other.ray_writes;
  end_writes += other.end_writes;
  bit_level_tests += other.bit_level_tests;
  return *this;
}

RayUnit::RayUnit(const Options& options)
    : options_(checked(options)),
      model_(*options.verilated),
      rays_(options.feed->unit(static_cast<std::size_t>(options.rays_in_flight))),
      operands_(options.verilated->operand_count()),
      results_(options.verilated->results().size()),
      counts_(UnitCounts::zeros(options.referee)) {
  if (const auto& slots = options.verilated->unit().ray_slots)
    writer_.emplace(*slots, operands_.size(), static_cast<std::size_t>(options.rays_in_flight));
}

template <class Walk>
void RayUnit::receive(const Walk& walk, std::size_t number, Slot<Walk>& slot, bool in_turn) {
  ++counts_.tests;
  // A library call would take longer than the few results.
  bool same = in_turn;
  for (std::size_t i = 0; i < results_.size(); ++i) same = same && results_[i] == slot.expected[i];
  counts_.rtl_mismatches += same ? 0 : 1;
  walk.each_box(*slot.traversal, results_.data(), [&](const ref::Aabb& box, bool hit) {
    ++counts_.box_tests;
    counts_.hits += hit ? 1 : 0;
    if (!options_.referee) return;
    ref::Ray ray = slot.job.ray;
    ray.length = slot.traversal->length();
    const bool meets = ref::ray_meets_box(ray, box);
    *counts_.false_misses += meets && !hit ? 1 : 0;
    *counts_.false_hits += !meets && hit ? 1 : 0;
  });
  walk.answer(*rays_, number, *slot.traversal, results_.data());
}

void RayUnit::run(const std::function<std::optional<RayJob>()>& next,
                  const std::function<void(const RayJob&, const ref::Hit&)>& ended) {
  with_walk({options_.feed, options_.bvh, options_.mesh}, options_.verilated->results(),
            [&](const auto& one) { walk(one, next, ended); });
  if (!writer_) return;
  counts_.ray_writes = writer_->rays_written();
  counts_.end_writes = writer_->ends_written();
}

template <class Walk>
void RayUnit::walk(const Walk& walk, const std::function<std::optional<RayJob>()>& next,
                   const std::function<void(const RayJob&, const ref::Hit&)>& ended) {
  std::vector<Slot<Walk>> slots(static_cast<std::size_t>(options_.rays_in_flight));
  SlotQueue ready(slots.size());  // slots whose ray can send a test
  std::vector<std::size_t> free;
  for (std::size_t slot = slots.size(); slot-- > 0;) free.push_back(slot);
  std::uint64_t sent = 0;
  std::uint64_t answered = 0;
  std::size_t in_pipeline = 0;
  // A test is in the pipeline in every cycle, or a ray is written. If no answer comes for longer than these
  // take, the Verilog has lost an answer.
  int silent_cycles = 0;
  const int longest_silence =
      options_.verilated->latency() + options_.verilated->unit().pipeline.interval() + (writer_ ? 2 : 1);
  const auto can_send = [&](std::size_t slot) {
    if (writer_) {
      Walk::ask(*rays_, slot, *slots[slot].traversal, operands_.data());
      if (!writer_->holds(slot, operands_.data())) return;
    }
    ready.push(slot);
  };

  while (true) {
    while (!free.empty()) {
      std::optional<RayJob> job = next();
      if (!job) break;
      const std::size_t slot = free.back();
      free.pop_back();
      slots[slot].traversal.emplace(walk.start(*rays_, slot, job->ray, job->query));
      slots[slot].job = *job;
      if (writer_) writer_->start(slot);
      can_send(slot);
    }
    if (ready.empty() && in_pipeline == 0 && (!writer_ || writer_->idle())) return;

    Pins pins{.results = results_.data()};
    const bool sending = !ready.empty();
    const std::size_t sender = sending ? ready.front() : 0;
    const bool bit_level = !options_.on_float_unit || sent % bit_level_stride == 0;
    if (sending) {
      Walk::ask(*rays_, sender, *slots[sender].traversal, operands_.data());
      pins.in_valid = true;
      pins.in_tag = static_cast<std::uint16_t>(sender);
    }
    if (writer_) writer_->drive(pins);
    rtl_time_.run([&] { model_.cycle(operands_.data(), pins); });
    ++counts_.cycles;
    if (sending && pins.in_ready) {
      (bit_level ? options_.evaluate : *options_.on_float_unit)(operands_.data(),
                                                                slots[sender].expected.data());
      ready.pop();
      slots[sender].waiting = true;
      slots[sender].turn = sent++;
      counts_.bit_level_tests += bit_level ? 1 : 0;
      ++in_pipeline;
    }
    if (writer_) {
      if (const std::optional<std::size_t> written = writer_->written()) ready.push(*written);
    }
    if (++silent_cycles > longest_silence) {
      throw WrongHardware("the Verilog did not answer a box test within its latency");
    }
    if (!pins.out_valid) continue;

    const std::size_t slot = pins.out_tag;
    const std::uint64_t turn = answered++;
    if (slot >= slots.size() || !slots[slot].waiting) {
      ++counts_.rtl_mismatches;
      continue;
    }
    silent_cycles = 0;
    --in_pipeline;
    Slot<Walk>& s = slots[slot];
    s.waiting = false;
    receive(walk, slot, s, s.turn == turn);
    if (!s.traversal->done()) {
      can_send(slot);
      continue;
    }
    counts_.triangle_tests += s.traversal->counts().triangle_tests;
    ended(s.job, s.traversal->hit());
    free.push_back(slot);
  }
}

}  // namespace hitpipe::sim
