// Ports of a core that several of its machines are wired to (docs/core.md).
#pragma once

#include <tuple>

#include "hls/machines/id_queue.hpp"
#include "hls/machines/record.hpp"

namespace hitpipe::hls::core_ports {

/// Of an origin.
inline constexpr auto point_bits = [](const auto& format) { return format.point(); };

// A new ray, as the unit int_ray makes it (hls/world/ray_operands.hpp): what both tests want to know.
constexpr Data<"ray_valid"> ray_valid;  // this and `ray_ready` are 1: the ray begins
constexpr Data<"ray_ready"> ray_ready;
constexpr Data<"begun_at", ray_bits> begun_at;
constexpr Data<"ray_major_y"> ray_major_y;
constexpr Data<"ray_major_z"> ray_major_z;
constexpr Data<"ray_back_m"> ray_back_m;
constexpr Data<"ray_back_a"> ray_back_a;
constexpr Data<"ray_back_b"> ray_back_b;
constexpr SignedData<"ray_origin_m", point_bits> ray_origin_m;
constexpr SignedData<"ray_origin_a", point_bits> ray_origin_a;
constexpr SignedData<"ray_origin_b", point_bits> ray_origin_b;
struct NewRay : List<ray_valid, ray_ready, begun_at, ray_major_y, ray_major_z, ray_back_m, ray_back_a,
                     ray_back_b, ray_origin_m, ray_origin_a, ray_origin_b> {};

// A block of the image that memory gives: 32 bytes as four words, the first bytes in the low bits of word 0.
// Above the ray's number an identifier has a bit that is 1 for a triangle.
constexpr Data<"read_valid"> read_valid;
constexpr Data<"read_id", ray_count_bits> read_id;
constexpr Data<"read_word_0", 64> read_word_0;
constexpr Data<"read_word_1", 64> read_word_1;
constexpr Data<"read_word_2", 64> read_word_2;
constexpr Data<"read_word_3", 64> read_word_3;
struct BlockRead : List<read_valid, read_id, read_word_0, read_word_1, read_word_2, read_word_3> {};

/// Who gets the block.
constexpr auto read_ray(const auto& in) {
  return slice(in[read_id], width_of(in[read_id]) - 2_w, 0_w);
}
constexpr auto reads_triangle(const auto& in) {
  return sign(in[read_id]);
}
/// Bits At .. At + Bits - 1 of the block.
template <int At, int Bits>
constexpr auto piece(const auto& in) {
  constexpr auto word = []<int I>(Width<I>) {
    return std::get<I>(std::tuple(read_word_0, read_word_1, read_word_2, read_word_3));
  };
  constexpr int first = At / 64, last = (At + Bits - 1) / 64, low = At % 64;
  const auto& lower = in[word(Width<first>())];
  if constexpr (first == last)
    return slice(lower, Width<low + Bits - 1>(), Width<low>());
  else
    return cat(slice(in[word(Width<last>())], Width<(At + Bits - 1) % 64>(), 0_w),
               slice(lower, 63_w, Width<low>()));
}
/// The coordinate with that number, in `width` bits.
template <int I>
constexpr auto coordinate(const auto& in, const auto& width) {
  return resize(as_signed(piece<24 * I, 24>(in)), width);
}

}  // namespace hitpipe::hls::core_ports
