#include "rtl_gen/catalogue/format.hpp"

#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::rtl {

std::string to_string(Format format) {
  if (format.is_float()) return "fp32";
  return fmt::format("{}/{}", format.bits().coord, format.bits().interval);
}

hls::IntBits parse_bits(std::string_view text) {
  hls::IntBits bits{.coord = 0, .interval = 0};
  const char* const end = text.data() + text.size();
  const auto [slash, bad_coord] = std::from_chars(text.data(), end, bits.coord);
  bool good = bad_coord == std::errc{} && slash != end && *slash == '/';
  if (good) {
    const auto [rest, bad_interval] = std::from_chars(slash + 1, end, bits.interval);
    good = bad_interval == std::errc{} && rest == end;
  }
  if (!good || !bits.valid()) {
    throw std::runtime_error(
        fmt::format("bits {}: allowed is n/t with n in {}..{} and t in {}..2n-1, for example 20/24", text,
                    hls::IntBits::min_coord, hls::IntBits::max_coord, hls::IntBits::min_interval));
  }
  return bits;
}

}  // namespace hitpipe::rtl
