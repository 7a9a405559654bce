#include "hls/pipelines/int_major_pair.hpp"

#include "rtl_gen/catalogue/design_of.hpp"
#include "rtl_gen/catalogue/major_formats.hpp"

namespace hitpipe::rtl {

Design int_major_pair() {
  return design_of<hls::IntMajorPair>("IntMajorPair");
}

}  // namespace hitpipe::rtl
