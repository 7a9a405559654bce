#include "hls/machines/walker.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine walker() {
  return machine_of<hls::Walker>();
}

}  // namespace hitpipe::rtl
