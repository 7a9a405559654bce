#include "hls/machines/replies.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine replies() {
  return machine_of<hls::Replies>();
}

}  // namespace hitpipe::rtl
