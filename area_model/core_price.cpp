#include "area_model/core_price.hpp"

#include "area_model/price.hpp"

namespace hitpipe::area {

CorePrice price(const rtl::Core& core, const rtl::Library& library) {
  CorePrice made;
  for (const rtl::Part& part : core.parts) {
    CorePartPrice& of = made.parts.emplace_back();
    if (part.graph) {
      const MachinePrice machine = price(*part.graph, library);
      of = {machine.memory_bits, machine.area_um2, machine.taken};
    } else {
      const Price unit =
          price(*part.pipeline, *part.design, part.format, library, part.interface.flow_control());
      of = {0, unit.area_um2, unit.taken};
    }
    made.all.memory_bits += of.memory_bits;
    made.all.area_um2 += of.area_um2;
    made.all.taken += of.taken;
  }
  return made;
}

}  // namespace hitpipe::area
