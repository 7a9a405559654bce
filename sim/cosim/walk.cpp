#include "sim/cosim/walk.hpp"

namespace hitpipe::sim {

PairResults::PairResults(std::span<const hls::Result> results)
    : order_(place_of_result(results, hls::Meaning::order, 0)) {
  for (std::size_t box = 0; box < 2; ++box) {
    const int number = static_cast<int>(box);
    hit_[box] = place_of_result(results, hls::Meaning::hit, number);
    near_[box] = place_of_result(results, hls::Meaning::entry, number);
    far_[box] = place_of_result(results, hls::Meaning::exit, number);
  }
}

}  // namespace hitpipe::sim
