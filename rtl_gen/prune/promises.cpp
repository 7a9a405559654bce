#include "rtl_gen/prune/promises.hpp"

namespace hitpipe::rtl {

Demands promises(const Design& design, const Format& format) {
  Demands all;
  for (const Port& port : design.ports(format)) {
    if (port.range && *port.range != all_numbers(port)) all.ports.push_back({port.name, {*port.range}});
  }
  return all;
}

}  // namespace hitpipe::rtl
