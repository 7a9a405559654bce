#include "sim/cosim/walk.hpp"

#include <algorithm>
#include <stdexcept>

namespace hitpipe::sim {

std::size_t place_of_result(std::span<const hls::Result> results, hls::Meaning meaning, int box) {
  const auto found = std::find_if(results.begin(), results.end(), [&](const hls::Result& each) {
    return each.meaning == meaning && each.box == box;
  });
  if (found == results.end())
    throw std::runtime_error("the design does not have the results that its traversal needs");
  return static_cast<std::size_t>(found - results.begin());
}

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
