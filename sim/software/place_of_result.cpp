#include "sim/software/place_of_result.hpp"

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

}  // namespace hitpipe::sim
