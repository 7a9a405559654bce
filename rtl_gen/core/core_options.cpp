#include "rtl_gen/core/core_options.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "hls/machines/rings.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe::rtl {

namespace {

void check_cache(const CoreOptions& options) {
  const int kib = options.cache_kib;
  if (kib < 2 || kib > CoreOptions::most_cache_kib || (kib & (kib - 1)) != 0)
    throw std::runtime_error(fmt::format("a cache of {} KiB: allowed is 0, or a power of two from 2 to {}",
                                         kib, CoreOptions::most_cache_kib));
  if (options.cache_line != 32 && options.cache_line != 64)
    throw std::runtime_error(
        fmt::format("a cache's lines of {} bytes: allowed is 32, 64", options.cache_line));
  if (options.cache_ways != 4 && options.cache_ways != 8)
    throw std::runtime_error(fmt::format("a cache with {} ways: allowed is 4, 8", options.cache_ways));
  if (!cache_bits(options).valid())
    throw std::runtime_error(
        fmt::format("a cache of {} KiB holds more blocks than {} bits number; allowed is a smaller one", kib,
                    options.address_bits));
}

void check_rings(const CoreOptions& options) {
  if (options.door != Door::binary32)
    throw std::runtime_error("rays from memory: allowed with floats at the door, not with integers");
  if (options.weights)
    throw std::runtime_error("weights of the corners: allowed with rays at pins, not with rays from memory");
  if (options.tag_bits > hls::RingBits::most_tag)
    throw std::runtime_error(fmt::format("bits of a tag {}: with rays from memory, allowed is 1 to {}",
                                         options.tag_bits, hls::RingBits::most_tag));
}

}  // namespace

hls::CacheBits cache_bits(const CoreOptions& options) {
  const int lines = (options.cache_kib << 10) / options.cache_line;
  return {.address = options.address_bits,
          .bytes = options.byte_bits,
          .ray = options.ray_bits(),
          .set = hls::count_bits(lines / options.cache_ways),
          .ways = options.cache_ways,
          .blocks = 8 * options.cache_line / CoreOptions::block_bits,
          .data = options.data_bits,
          .ids = options.has_one_id() ? 0 : 1};
}

void check_core_options(const CoreOptions& options) {
  const auto within = [](const char* what, int value, int least, int most) {
    if (value < least || value > most)
      throw std::runtime_error(fmt::format("{} {}: allowed is {} to {}", what, value, least, most));
  };
  if (!options.bits.valid())
    throw std::runtime_error(fmt::format("core: there is no format {}; allowed is {}",
                                         to_string(Format(options.bits)),
                                         Format(options.bits).family().allowed()));
  within("rays in flight", options.rays, 1, CoreOptions::most_rays);
  within("bits of places on a stack", options.stack_bits, 1, 6);
  within("levels", options.levels, 2, CoreOptions::most_levels);
  within("bits of a block's number", options.address_bits, 4, 32);
  within("bits of an address", options.byte_bits, options.address_bits + 5, 64);
  within("bits of a triangle's number", options.number_bits, 4, hls::triangle_number_bits);
  within("bits of the number of triangles in a leaf", options.leaf_bits, 2, hls::child_count_bits);
  within("bits of the number of steps", options.step_bits, 4, hls::step_count_bits);
  within("block RAMs", options.block_rams, 0, CoreOptions::most_block_rams);
  within("bits of a tag", options.tag_bits, 1, 64);
  if (options.data_bits < 64 || options.data_bits > 512 || (options.data_bits & (options.data_bits - 1)) != 0)
    throw std::runtime_error(
        fmt::format("bits of the memory bus {}: allowed is 64, 128, 256, 512", options.data_bits));
  if (options.serial() && options.weights)
    throw std::runtime_error(
        "weights of the corners: allowed with a triangle unit, not with the serial test");
  if (options.questions && options.serial())
    throw std::runtime_error(
        "questions count and next: allowed with a triangle unit, not with the serial test");
  if (options.questions && options.rings)
    throw std::runtime_error(
        "questions count and next: allowed with rays at pins, not with rays from memory");
  if (!options.serial())
    within("cycles from triangle to triangle", options.triangle_interval,
           CoreOptions::least_triangle_interval, 64);
  if (options.has_cache()) check_cache(options);
  if (options.rings) check_rings(options);
}

int CoreOptions::ray_bits() const {
  return std::max(1, hls::count_bits(rays));
}

std::string CoreOptions::module() const {
  const std::string name = "hitpipe_core";
  return bits == CoreOptions{}.bits ? name : fmt::format("{}_{}", name, Format(bits).identifier());
}

}  // namespace hitpipe::rtl
