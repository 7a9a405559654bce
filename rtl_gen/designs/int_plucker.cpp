#include "hls/pipelines/int_plucker.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design int_plucker() {
  Design design = design_of<hls::IntPlucker>("IntPlucker");
  // A side relation needs t+1 bits (section 6.3.2); the table prices t.
  design.printed = {.rows = {{5, hls::IntBits{24, 24}}, {6, hls::IntBits{20, 24}}},
                    .side_relations_at_t = true};
  return design;
}

}  // namespace hitpipe::rtl
