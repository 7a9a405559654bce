#include "hls/pipelines/int_ray.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design int_ray() {
  return design_of<hls::IntRay>("IntRay");
}

}  // namespace hitpipe::rtl
