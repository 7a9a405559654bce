#include "sim/ray_unit.hpp"

#include <deque>
#include <stdexcept>

#include <fmt/format.h>

#include "sim/wrong_hardware.hpp"
#include "sw_ref/exact/box_referee.hpp"

namespace hitpipe::sim {

namespace {

void add(std::optional<std::uint64_t>& sum, const std::optional<std::uint64_t>& count) {
  if (sum && count) {
    *sum += *count;
  } else {
    sum.reset();
  }
}

const RayUnit::Setup& checked(const RayUnit::Setup& setup) {
  if (setup.rays_in_flight < 1 || setup.rays_in_flight > RayUnit::most_rays_in_flight)
    throw std::invalid_argument(fmt::format("{} rays in flight: allowed is 1 to {}", setup.rays_in_flight,
                                            RayUnit::most_rays_in_flight));
  return setup;
}

}  // namespace

UnitCounts UnitCounts::zeros(bool referee) {
  UnitCounts counts;
  if (referee) counts.false_misses = counts.false_hits = 0;
  return counts;
}

UnitCounts& UnitCounts::operator+=(const UnitCounts& other) {
  box_tests += other.box_tests;
  triangle_tests += other.triangle_tests;
  hits += other.hits;
  rtl_mismatches += other.rtl_mismatches;
  add(false_misses, other.false_misses);
  add(false_hits, other.false_hits);
  cycles += other.cycles;
  return *this;
}

RayUnit::RayUnit(const Setup& setup)
    : setup_(checked(setup)),
      model_(*setup.verilated),
      rays_(setup.feed->unit(static_cast<std::size_t>(setup.rays_in_flight))),
      slots_(static_cast<std::size_t>(setup.rays_in_flight)),
      operands_(setup.verilated->operand_count()),
      results_(setup.verilated->results().size()),
      counts_(UnitCounts::zeros(setup.referee)) {
  for (Slot& slot : slots_) slot.expected.resize(results_.size());
}

void RayUnit::send(std::size_t slot, Pins& pins) {
  Slot& s = slots_[slot];
  rays_->operands(slot, s.traversal->node(), s.traversal->length(), operands_.data());
  setup_.evaluate(operands_.data(), s.expected.data());
  pins.in_valid = true;
  pins.in_tag = static_cast<std::uint16_t>(slot);
}

void RayUnit::receive(const Pins& pins, bool in_turn) {
  Slot& s = slots_[pins.out_tag];
  ++counts_.box_tests;
  counts_.hits += pins.hit ? 1 : 0;
  counts_.rtl_mismatches += results_ != s.expected || !in_turn ? 1 : 0;
  if (setup_.referee) {
    ref::Ray ray = s.job.ray;
    ray.length = s.traversal->length();
    const bool meets = ref::ray_meets_box(ray, setup_.bvh->nodes[s.traversal->node()].box);
    *counts_.false_misses += meets && !pins.hit ? 1 : 0;
    *counts_.false_hits += !meets && pins.hit ? 1 : 0;
  }
  s.traversal->answer(pins.hit);
}

void RayUnit::run(const std::function<std::optional<RayJob>()>& next,
                  const std::function<void(const RayJob&, const ref::Traversal&)>& ended) {
  std::deque<std::size_t> ready;  // slots whose ray can send a box
  std::vector<std::size_t> free;
  std::vector<bool> waiting(slots_.size(), false);  // the slot waits for an answer
  for (std::size_t slot = slots_.size(); slot-- > 0;) free.push_back(slot);
  std::uint64_t sent = 0;
  std::uint64_t answered = 0;
  std::size_t in_pipeline = 0;
  // A box is in the pipeline in every cycle. When no answer comes for longer than that takes, the Verilog has
  // lost one.
  int silent_cycles = 0;

  while (true) {
    while (!free.empty()) {
      std::optional<RayJob> job = next();
      if (!job) break;
      const std::size_t slot = free.back();
      free.pop_back();
      rays_->start(slot, job->ray);
      slots_[slot].traversal.emplace(*setup_.bvh, *setup_.mesh, job->ray, job->query);
      slots_[slot].job = *job;
      ready.push_back(slot);
    }
    if (ready.empty() && in_pipeline == 0) return;

    Pins pins{.results = results_.data()};
    const bool sending = !ready.empty();
    const std::size_t sender = sending ? ready.front() : 0;
    if (sending) send(sender, pins);
    rtl_time_.run([&] { model_.cycle(operands_.data(), pins); });
    ++counts_.cycles;
    if (sending && pins.in_ready) {
      ready.pop_front();
      waiting[sender] = true;
      slots_[sender].turn = sent++;
      ++in_pipeline;
    }
    if (++silent_cycles > setup_.verilated->latency() + 2) {
      throw WrongHardware("the Verilog did not answer a box test within its latency");
    }
    if (!pins.out_valid) continue;

    const std::size_t slot = pins.out_tag;
    const std::uint64_t turn = answered++;
    if (slot >= slots_.size() || !waiting[slot]) {
      ++counts_.rtl_mismatches;
      continue;
    }
    silent_cycles = 0;
    waiting[slot] = false;
    --in_pipeline;
    receive(pins, slots_[slot].turn == turn);
    Slot& s = slots_[slot];
    if (!s.traversal->done()) {
      ready.push_back(slot);
      continue;
    }
    counts_.triangle_tests += s.traversal->counts().triangle_tests;
    ended(s.job, *s.traversal);
    free.push_back(slot);
  }
}

}  // namespace hitpipe::sim
