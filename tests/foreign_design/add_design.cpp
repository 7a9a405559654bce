// Adds the foreign design to the catalogue; tests/main.cpp calls it where a program links it.
#include "rtl_gen/catalogue/design.hpp"
#include "tests/foreign_design/foreign_design.hpp"

namespace hitpipe {

namespace rtl {
[[nodiscard]] Design block_slabs();
}

void add_foreign_design() {
  rtl::add_design(rtl::block_slabs());
}

}  // namespace hitpipe
