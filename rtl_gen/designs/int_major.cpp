#include "hls/pipelines/int_major.hpp"

#include "hls/box/major_format.hpp"
#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design int_major() {
  return design_of<hls::IntMajor>("IntMajor");
}

}  // namespace hitpipe::rtl
