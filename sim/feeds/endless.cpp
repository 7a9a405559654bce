#include "sim/feeds/endless.hpp"

#include <stdexcept>

namespace hitpipe::sim {

OperandStep endless_step(const std::vector<rtl::Port>& ports) {
  const auto at = rtl::index_of(ports, hls::Role::endless);
  if (!at) throw std::invalid_argument("endless rays: no operand says that a ray has no end");
  return [at = *at](std::int64_t* operands) { operands[at] = 1; };
}

}  // namespace hitpipe::sim
