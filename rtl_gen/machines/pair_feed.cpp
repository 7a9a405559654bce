#include "hls/machines/pair_feed.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine pair_feed() {
  return machine_of<hls::PairFeed>();
}

}  // namespace hitpipe::rtl
