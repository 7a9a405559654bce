// Operands and results as bytes: all bits in port order, the first port in the low bits, the lowest byte
// first.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"

namespace hitpipe::sim {

/// As many bytes as rtl::packed_bytes() says. The bits above the last port are 0.
[[nodiscard]] std::string pack(const std::vector<rtl::Port>& ports, std::span<const std::int64_t> values);
/// Signed ports are sign-extended. `bytes` are as many as pack() gives.
[[nodiscard]] std::vector<std::int64_t> unpack(const std::vector<rtl::Port>& ports, std::string_view bytes);

}  // namespace hitpipe::sim
