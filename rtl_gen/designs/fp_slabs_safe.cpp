#include "hls/pipelines/fp_slabs_safe.hpp"

#include "hls/box/fp_format.hpp"
#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design fp_slabs_safe() {
  return design_of<hls::FpSlabsSafe>("FpSlabsSafe");
}

}  // namespace hitpipe::rtl
