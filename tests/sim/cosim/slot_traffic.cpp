#include "tests/sim/cosim/slot_traffic.hpp"

#include <algorithm>
#include <deque>
#include <random>

namespace hitpipe::sim {
namespace {

using Numbers = std::vector<std::int64_t>;

struct Asked {
  std::uint16_t slot;
  std::uint16_t tag;
  Numbers results;
};

/// A slot: what the memory must hold, and the vector that its line is from.
struct Held {
  Numbers operands;
  std::size_t vector = 0;
};

}  // namespace

SlotReport slot_traffic(const VerilatedDesign& design, const rtl::Evaluate& evaluate,
                        const std::vector<Numbers>& vectors, std::uint64_t tests, std::uint64_t seed) {
  const rtl::RaySlots& memory = design.unit().ray_slots.value();
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  const auto one_in = [&](std::size_t count) { return below(count) == 0; };

  Model model(design);
  SlotReport report;
  std::vector<Held> slots(static_cast<std::size_t>(memory.slots()));
  std::size_t unwritten = slots.size();
  std::deque<Asked> asked;
  Numbers results(evaluate.result_count());
  Numbers results_before;
  Pins before;
  const auto copy = [](Numbers& to, const Numbers& from, const std::vector<std::size_t>& places) {
    for (const std::size_t place : places) to[place] = from[place];
  };

  bool offering = false;
  std::uint16_t slot = 0;
  std::uint16_t tag = 0;
  Numbers test;
  std::uint64_t cycles = 0;
  const int interval = design.unit().pipeline->interval();
  for (; report.received < tests && cycles < 20 * tests + 1000; ++cycles) {
    RayPins rays;
    std::size_t from = 0;
    if (unwritten > 0 || one_in(3)) {
      rays.slot = static_cast<std::uint16_t>(unwritten > 0 ? --unwritten : below(slots.size()));
      from = below(vectors.size());
      rays.valid = true;
      rays.end_only = !memory.end.empty() && !slots[rays.slot].operands.empty() && one_in(2);
      rays.operands = vectors[from].data();
    }
    const bool all_written = unwritten == 0 && !(rays.valid && slots[rays.slot].operands.empty());
    if (!offering && all_written && !one_in(4)) {
      offering = true;
      slot = static_cast<std::uint16_t>(below(slots.size()));
      tag = static_cast<std::uint16_t>(random());
      // A box of the slot's ray, so that about half of the tests hit.
      test = vectors[one_in(4) ? below(vectors.size()) : slots[slot].vector];
    }
    rays.in_slot = slot;
    Pins pins{.results = results.data(), .rays = &rays};
    pins.in_valid = offering;
    pins.in_tag = tag;
    pins.out_ready = !one_in(3);
    pins.rst = one_in(200);
    model.cycle(test.data(), pins);

    const bool beside = rays.valid && rays.slot == slot;
    const bool moves = pins.out_ready || !pins.out_valid;
    // With an interval of more than a cycle the unit itself may not be ready.
    if (interval == 1 && offering && moves && !beside && !pins.in_ready) ++report.refused;
    if (offering && moves && beside && !pins.in_ready) ++report.waited_for_write;
    if (before.out_valid && !before.out_ready &&
        !(pins.out_valid && pins.out_tag == before.out_tag && results == results_before))
      ++report.not_held;
    if (pins.out_valid && pins.out_ready) {
      if (asked.empty()) {
        ++report.surplus;
      } else {
        const Asked& oldest = asked.front();
        report.wrong_answers += results != oldest.results || pins.out_tag != oldest.tag ? 1 : 0;
        report.hits += pins.hit ? 1 : 0;
        ++report.received;
        asked.pop_front();
      }
    }
    const bool taken = offering && pins.in_ready && !pins.rst;
    if (taken) {
      report.beside_write += beside ? 1 : 0;
      copy(test, slots[slot].operands, memory.line_places);
      copy(test, slots[slot].operands, memory.end_places);
      asked.push_back({slot, tag, Numbers(results.size())});
      evaluate(test.data(), asked.back().results.data());
      offering = false;
    }
    if (rays.valid) {
      if (!rays.ready) ++report.write_refused;
      Held& held = slots[rays.slot];
      held.operands.resize(vectors[from].size());
      copy(held.operands, vectors[from], memory.end_places);
      if (!rays.end_only) {
        copy(held.operands, vectors[from], memory.line_places);
        held.vector = from;
      }
      report.ends += rays.end_only ? 1 : 0;
      report.under_way +=
          std::any_of(asked.begin(), asked.end(), [&](const Asked& each) { return each.slot == rays.slot; })
              ? 1
              : 0;
    }
    before = pins;
    results_before = results;
    if (pins.rst) {
      ++report.resets;
      asked.clear();
      before = Pins{};
    }
  }
  report.lost = tests - report.received;
  return report;
}

}  // namespace hitpipe::sim
