#include "hls/machines/divider.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine divider() {
  return machine_of<hls::Divider>();
}

}  // namespace hitpipe::rtl
