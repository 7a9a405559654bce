#include "hls/pipelines/fp_plucker_direct.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design fp_plucker_direct() {
  return design_of<hls::FpPluckerDirect>("FpPluckerDirect");
}

}  // namespace hitpipe::rtl
