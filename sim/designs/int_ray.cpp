// The unit that makes integer rays tests no boxes (docs/integer_world.md).
#include "sim/software/software.hpp"

namespace hitpipe::sim {

Software int_ray_software() {
  return {};
}

}  // namespace hitpipe::sim
