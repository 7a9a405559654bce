#include "hls/pipelines/fp_slabs.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design fp_slabs() {
  Design design = design_of<hls::FpSlabs>("FpSlabs");
  design.printed = {.rows = {{1, hls::Binary32{}}}, .input_latches = true};
  return design;
}

}  // namespace hitpipe::rtl
