// Thrown when the hardware itself is wrong and cannot go on, unlike bad input.
#pragma once

#include <stdexcept>

namespace hitpipe::sim {

class WrongHardware : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hitpipe::sim
