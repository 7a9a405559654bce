#include "hls/machines/serial_triangle.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine serial_triangle() {
  return machine_of<hls::SerialTriangle>();
}

}  // namespace hitpipe::rtl
