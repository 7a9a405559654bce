#include "sim/cosim/station.hpp"

#include <stdexcept>

namespace hitpipe::sim {

namespace {

std::size_t checked(int rays, const VerilatedDesign& verilated) {
  Station::check(rays);
  if (const auto& slots = verilated.unit().ray_slots) check_slots(rays, slots->slots());
  return static_cast<std::size_t>(rays);
}

}  // namespace

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
