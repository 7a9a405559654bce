#include "sim/cosim/counts.hpp"

#include <fmt/format.h>

namespace hitpipe::sim {

namespace {

void add(std::optional<std::uint64_t>& sum, const std::optional<std::uint64_t>& count) {
  if (sum && count) {
    *sum += *count;
  } else {
    sum.reset();
  }
}

}  // namespace

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

void check_slots(int rays, int slots) {
  if (rays > slots)
    throw std::invalid_argument(
        fmt::format("{} rays in flight: each needs a slot, and there are {} ray slots", rays, slots));
}

}  // namespace hitpipe::sim
