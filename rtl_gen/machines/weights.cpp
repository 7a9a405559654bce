#include "hls/machines/weights.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine weights() {
  return machine_of<hls::Weights>();
}

}  // namespace hitpipe::rtl
