#include "sim/feeds/endless.hpp"

#include <stdexcept>

namespace hitpipe::sim {

OperandStep endless_step(const std::vector<rtl::Port>& ports) {
  const std::size_t at = rtl::index_of(ports, "rinf");
  if (at == ports.size()) throw std::invalid_argument("endless rays: there is no port rinf");
  return [at](std::int64_t* operands) { operands[at] = 1; };
}

}  // namespace hitpipe::sim
