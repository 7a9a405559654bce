#include "hls/machines/triangle_feed.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine triangle_feed() {
  return machine_of<hls::TriangleFeed>();
}

}  // namespace hitpipe::rtl
