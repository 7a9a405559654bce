// Thrown when the hardware itself is wrong and the run cannot go on. Bad input throws other exceptions.
#pragma once

#include <stdexcept>

namespace hitpipe::sim {

class WrongHardware : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hitpipe::sim
