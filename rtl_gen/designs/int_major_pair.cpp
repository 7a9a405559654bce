#include "hls/pipelines/int_major_pair.hpp"

#include "hls/box/major_format.hpp"
#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design int_major_pair() {
  return design_of<hls::IntMajorPair>("IntMajorPair");
}

}  // namespace hitpipe::rtl
