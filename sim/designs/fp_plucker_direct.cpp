// fp_plucker_direct has the operands and the answers of fp_plucker.
#include "sim/software/software.hpp"

namespace hitpipe::sim {

// Declared in the list of designs too, which may be in one batch with this file.
// NOLINTNEXTLINE(readability-redundant-declaration)
Software fp_plucker_software();

Software fp_plucker_direct_software() {
  return fp_plucker_software();
}

}  // namespace hitpipe::sim
