// The designs that this folder adds to hitpipe's own.
#pragma once

#include "sim/software.hpp"

namespace hitpipe::sim {

[[nodiscard]] Software endless_slabs_software();

}  // namespace hitpipe::sim
