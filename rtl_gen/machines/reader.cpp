#include "hls/machines/reader.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine reader() {
  return machine_of<hls::Reader>();
}

}  // namespace hitpipe::rtl
