#include "area_model/core_price.hpp"

#include "area_model/price.hpp"

namespace hitpipe::area {

CorePartPrice& CorePartPrice::operator+=(const CorePartPrice& more) {
  memory_bits += more.memory_bits;
  area_um2 += more.area_um2;
  taken += more.taken;
  return *this;
}

CorePrice price(std::span<const rtl::Part> parts, const rtl::Library& library) {
  CorePrice made;
  for (const rtl::Part& part : parts) {
    CorePartPrice& of = made.parts.emplace_back();
    if (part.graph) {
      const MachinePrice machine = price(*part.graph, library);
      of = {machine.memory_bits, machine.area_um2, machine.taken};
    } else {
      const Price unit =
          price(*part.pipeline, *part.design, part.format, library, part.interface.flow_control());
      of = {0, unit.area_um2, unit.taken};
    }
    made.all += of;
  }
  return made;
}

}  // namespace hitpipe::area
