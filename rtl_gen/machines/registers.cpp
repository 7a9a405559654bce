#include "hls/machines/registers.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine registers() {
  return machine_of<hls::Registers>();
}

}  // namespace hitpipe::rtl
