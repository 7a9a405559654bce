// The operands and answers of fp_plucker_direct are those of fp_plucker.
#include "sim/software.hpp"

namespace hitpipe::sim {

// NOLINTNEXTLINE(readability-redundant-declaration): the list of designs, in one batch with this file, has it
// too
Software fp_plucker_software();

Software fp_plucker_direct_software() {
  return fp_plucker_software();
}

}  // namespace hitpipe::sim
