#include "hls/machines/requests.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine requests() {
  return machine_of<hls::Requests>();
}

}  // namespace hitpipe::rtl
