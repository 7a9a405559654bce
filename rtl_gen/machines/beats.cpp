#include "hls/machines/beats.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine beats() {
  return machine_of<hls::Beats>();
}

}  // namespace hitpipe::rtl
