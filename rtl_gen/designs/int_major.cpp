#include "hls/pipelines/int_major.hpp"

#include "rtl_gen/catalogue/design_of.hpp"
#include "rtl_gen/catalogue/major_formats.hpp"

namespace hitpipe::rtl {

Design int_major() {
  return design_of<hls::IntMajor>("IntMajor");
}

}  // namespace hitpipe::rtl
