#include "hls/pipelines/fp_plucker.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design fp_plucker() {
  Design design = design_of<hls::FpPlucker>("FpPlucker");
  design.printed = {.rows = {{2, hls::Binary32{}}}};
  return design;
}

}  // namespace hitpipe::rtl
