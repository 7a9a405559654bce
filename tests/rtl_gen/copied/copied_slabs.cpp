// A copy of int_slabs in a file of its own, as another design is.
#include "hls/pipelines/copied_slabs.hpp"

#include "rtl_gen/catalogue/traced.hpp"
#include "tests/rtl_gen/copied/copied_slabs.hpp"

namespace hitpipe::rtl {

Graph copied_slabs(const hls::IntBits& bits) {
  return traced<hls::CopiedSlabs>(bits);
}

}  // namespace hitpipe::rtl
