#include "hls/machines/door.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine door() {
  return machine_of<hls::Door>();
}

}  // namespace hitpipe::rtl
