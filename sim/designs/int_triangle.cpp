// The triangle unit has no boxes: its rays and triangles are integers (docs/integer_world.md).
#include "sim/software.hpp"

namespace hitpipe::sim {

Software int_triangle_software() {
  return {};
}

}  // namespace hitpipe::sim
