#include "hls/machines/best_hits.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine best_hits() {
  return machine_of<hls::BestHits>();
}

}  // namespace hitpipe::rtl
