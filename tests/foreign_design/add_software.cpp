// Adds what software knows of the foreign design; tests/main.cpp calls it where a program links it.
#include "sim/software/software.hpp"
#include "tests/foreign_design/foreign_design.hpp"

namespace hitpipe {

namespace sim {
[[nodiscard]] Software block_slabs_software();
}

void add_foreign_software() {
  sim::add_software("block_slabs", sim::block_slabs_software());
}

}  // namespace hitpipe
