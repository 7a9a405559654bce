#include "sim/feeds/endless.hpp"

#include <algorithm>
#include <stdexcept>

namespace hitpipe::sim {

OperandStep endless_step(const std::vector<rtl::Port>& ports) {
  const auto port = std::find_if(ports.begin(), ports.end(), [](const auto& p) { return p.name == "rinf"; });
  if (port == ports.end()) throw std::invalid_argument("endless rays: there is no port rinf");
  const auto at = port - ports.begin();
  return [at](std::int64_t* operands) { operands[at] = 1; };
}

}  // namespace hitpipe::sim
