#include "rtl_gen/core/identity.hpp"

namespace hitpipe::rtl {

CoreIdentity identity_of(const CoreOptions& options) {
  std::uint32_t word = 0;
  int used = 0;
  const auto add = [&](int value, int bits) {
    word |= static_cast<std::uint32_t>(value) << used;
    used += bits;
  };
  const auto taken = [&] {
    const std::uint32_t made = word;
    word = 0;
    used = 0;
    return made;
  };
  const hls::RayBits& bits = options.bits;
  add(bits.coord, 8);
  add(bits.finer, 4);
  add(bits.fraction, 4);
  add(bits.slope, 8);
  add(bits.mantissa, 8);
  CoreIdentity made{};
  made.format = taken();
  add(options.rays, 15);
  add(options.questions ? 1 : 0, 1);
  add(options.levels, 8);
  add(options.address_bits, 8);
  made.shape = taken();
  add(options.tag_bits, 8);
  add(options.byte_bits, 8);
  add(options.data_bits / 8, 7);
  add(options.rings ? 1 : 0, 1);
  for (const bool is :
       {options.door == Door::binary32, options.weights, options.serial(), options.has_one_id()})
    add(is ? 1 : 0, 1);
  add(options.has_cache() ? hls::count_bits(options.cache_kib) : 0, 3);
  add(options.has_cache() && options.cache_line == 32 ? 1 : 0, 1);
  made.ports = taken();
  return made;
}

}  // namespace hitpipe::rtl
