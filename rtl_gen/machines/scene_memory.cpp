#include "hls/machines/scene_memory.hpp"

#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::rtl {

Machine scene_memory() {
  return machine_of<hls::SceneMemory>();
}

}  // namespace hitpipe::rtl
