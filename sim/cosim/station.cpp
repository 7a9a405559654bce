#include "sim/cosim/station.hpp"

#include <stdexcept>

namespace hitpipe::sim {

namespace {

void add(std::optional<std::uint64_t>& sum, const std::optional<std::uint64_t>& count) {
  if (sum && count) {
    *sum += *count;
  } else {
    sum.reset();
  }
}

std::size_t checked(int rays, const VerilatedDesign& verilated) {
  Station::check(rays);
  if (const auto& slots = verilated.unit().ray_slots) check_slots(rays, slots->slots());
  return static_cast<std::size_t>(rays);
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

void Station::check(int rays) {
  if (rays < 1 || rays > most_rays)
    throw std::invalid_argument(fmt::format("{} rays in flight: allowed is 1 to {}", rays, most_rays));
}

Station::Station(const VerilatedDesign& verilated, StationSoftware software, int rays)
    : model_(verilated),
      software_(software),
      operands_(verilated.operand_count()),
      results_(verilated.results().size()),
      expected_(checked(rays, verilated)),
      longest_silence_(verilated.latency() + verilated.unit().interval() + 1) {
  if (const auto& slots = verilated.unit().ray_slots) {
    writer_.emplace(*slots, operands_.size(), expected_.size());
    ++longest_silence_;
  }
}

UnitCounts Station::counts() const {
  UnitCounts counts = counts_;
  if (writer_) {
    counts.ray_writes = writer_->rays_written();
    counts.end_writes = writer_->ends_written();
  }
  return counts;
}

}  // namespace hitpipe::sim
