#include "hls/pipelines/int_triangle.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design int_triangle() {
  return design_of<hls::IntTriangle>("IntTriangle");
}

}  // namespace hitpipe::rtl
