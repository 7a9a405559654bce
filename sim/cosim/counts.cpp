#include "sim/cosim/counts.hpp"

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
  bit_level_tests += other.bit_level_tests;
  return *this;
}

}  // namespace hitpipe::sim
