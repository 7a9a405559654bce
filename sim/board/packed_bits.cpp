#include "sim/board/packed_bits.hpp"

#include "hls/num/bits.hpp"
#include "rtl_gen/board/top.hpp"

namespace hitpipe::sim {

std::string pack(const std::vector<rtl::Port>& ports, std::span<const std::int64_t> values) {
  std::string bytes(static_cast<std::size_t>(rtl::packed_bytes(ports)), '\0');
  std::size_t place = 0;
  for (std::size_t port = 0; port < ports.size(); ++port) {
    for (int bit = 0; bit < ports[port].width; ++bit, ++place) {
      if (((static_cast<std::uint64_t>(values[port]) >> bit) & 1U) == 0) continue;
      bytes[place / 8] =
          static_cast<char>(static_cast<unsigned char>(bytes[place / 8]) | (1U << (place % 8)));
    }
  }
  return bytes;
}

std::vector<std::int64_t> unpack(const std::vector<rtl::Port>& ports, std::string_view bytes) {
  std::vector<std::int64_t> values;
  std::size_t place = 0;
  for (const rtl::Port& port : ports) {
    std::uint64_t value = 0;
    for (int bit = 0; bit < port.width; ++bit, ++place) {
      const unsigned byte = static_cast<unsigned char>(bytes[place / 8]);
      value |= static_cast<std::uint64_t>((byte >> (place % 8)) & 1U) << bit;
    }
    values.push_back(port.is_signed ? hls::sign_extended(value, port.width)
                                    : static_cast<std::int64_t>(value));
  }
  return values;
}

}  // namespace hitpipe::sim
