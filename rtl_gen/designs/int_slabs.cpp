#include "hls/pipelines/int_slabs.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design int_slabs() {
  Design design = design_of<hls::IntSlabs>("IntSlabs");
  // The 20/24 row has its product latches at 20 bits, though 24 bits are compared.
  design.printed = {.rows = {{3, hls::IntBits{24, 24}}, {4, hls::IntBits{20, 24}}},
                    .input_latches = true,
                    .products_at_n_bits = true};
  return design;
}

}  // namespace hitpipe::rtl
