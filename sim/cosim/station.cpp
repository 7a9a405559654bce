#include "sim/cosim/station.hpp"

#include <stdexcept>

namespace hitpipe::sim {

namespace {

std::size_t checked(int rays) {
  Station::check(rays);
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
      expected_(checked(rays)),
      longest_silence_(verilated.latency() + verilated.unit().interval() + 1) {}

}  // namespace hitpipe::sim
