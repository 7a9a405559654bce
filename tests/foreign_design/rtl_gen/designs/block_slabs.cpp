#include "hls/pipelines/block_slabs.hpp"

#include "rtl_gen/catalogue/design_of.hpp"

namespace hitpipe::rtl {

Design block_slabs() {
  return design_of<hls::BlockSlabs>();
}

}  // namespace hitpipe::rtl
