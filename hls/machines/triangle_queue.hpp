// Triangles that memory gives, and the rays that wanted them (docs/core.md). It is in triangle_feed and in
// serial_triangle. A test takes longer than a read, so triangles wait in a queue. A ray wants one triangle at
// a time, so the queue has a place for each. When the oldest is there, the words of its ray are asked for,
// and from the next cycle on it may be tested.
#pragma once

#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls::triangle_queue {

using namespace channels;

/// A new ray, and a block that memory gives, which may be a triangle.
struct In : Join<Begun, Direction, List<ray_s_a, ray_s_b>, BlockRead> {};

using Queue = IdQueue<>;
constexpr Control<"ready"> ready;      // the words of the oldest triangle's ray are there
constexpr Control<"reads_1"> reads_1;  // a triangle has come in the last cycle
constexpr Data<"reader_1", ray_bits> reader_1;
constexpr Data<"number_1", number_bits> number_1;
constexpr Data<"unread_1"> unread_1;
struct State : Join<Queue::State, List<ready, reads_1, reader_1, number_1, unread_1>> {};

// The oldest triangle by axis, and its ray by ray axis. They mean something if `ready` is 1.
constexpr Data<"major_y"> major_y;
constexpr Data<"major_z"> major_z;
constexpr Data<"back_m"> back_m;
constexpr SignedData<"origin_m", point_bits> origin_m;
constexpr SignedData<"origin_a", point_bits> origin_a;
constexpr SignedData<"origin_b", point_bits> origin_b;
constexpr SignedData<"slope_a", &CoreBits::direction>
    slope_a;  // divided by the direction's sign on the major axis
constexpr SignedData<"slope_b", &CoreBits::direction> slope_b;
constexpr SignedData<"x0", &CoreBits::coord> x0;
constexpr SignedData<"y0", &CoreBits::coord> y0;
constexpr SignedData<"z0", &CoreBits::coord> z0;
constexpr SignedData<"x1", &CoreBits::coord> x1;
constexpr SignedData<"y1", &CoreBits::coord> y1;
constexpr SignedData<"z1", &CoreBits::coord> z1;
constexpr SignedData<"x2", &CoreBits::coord> x2;
constexpr SignedData<"y2", &CoreBits::coord> y2;
constexpr SignedData<"z2", &CoreBits::coord> z2;
struct Origins : List<major_y, major_z, back_m, origin_m, origin_a, origin_b> {};
struct Slopes : List<slope_a, slope_b> {};
struct Corner0 : List<x0, y0, z0> {};
struct Corner1 : List<x1, y1, z1> {};
struct Corner2 : List<x2, y2, z2> {};

constexpr Block<"rays", &CoreBits::rays, ray_bits> rays;  // the queue
constexpr BlockOf<"corners_0", &CoreBits::rays, Corner0> corners_0;
constexpr BlockOf<"corners_1", &CoreBits::rays, Corner1> corners_1;
constexpr BlockOf<"corners_2", &CoreBits::rays, Corner2> corners_2;
constexpr BlockOf<"origins", &CoreBits::rays, Origins> origins;  // by ray
constexpr BlockOf<"slopes", &CoreBits::rays, Slopes> slopes;
struct Memory : List<rays, corners_0, corners_1, corners_2, origins, slopes> {};

/// One cycle. The oldest leaves if `leaves` is 1; only one that is ready may leave.
template <class D>
constexpr void step(const auto& f, const auto& now, const auto& in, const auto& leaves, const auto& memory,
                    const auto& next) {
  using Bit = typename D::bit;
  const Bit begins = as("ray_begins", in[ray_valid] & in[ray_ready]);
  const auto slope = [&](const auto& size, const Bit& back) {
    const auto bits = slope_a.width(f);
    const Bit negative = back ^ in[ray_back_m];
    return plus(resize(size, bits) ^ spread(negative, bits), negative);
  };
  memory[slopes].write(begins, in[begun_at], slope(in[ray_s_a], in[ray_back_a]),
                       slope(in[ray_s_b], in[ray_back_b]));
  memory[origins].write(begins, in[begun_at], in[ray_major_y], in[ray_major_z], in[ray_back_m],
                        in[ray_origin_m], in[ray_origin_a], in[ray_origin_b]);

  const Bit enters = as("reads_triangle", in[read_valid] & Bit(reads_triangle(in)));
  const auto place = as("place", Queue::place(now));
  const auto n = x0.width(f);
  memory[rays].write(enters, place, reader_of(in));
  memory[corners_0].write(enters, place, coordinate<0>(in, n), coordinate<1>(in, n), coordinate<2>(in, n));
  memory[corners_1].write(enters, place, coordinate<3>(in, n), coordinate<4>(in, n), coordinate<5>(in, n));
  memory[corners_2].write(enters, place, coordinate<6>(in, n), coordinate<7>(in, n), coordinate<8>(in, n));
  const auto oldest_ray = memory[rays].word();
  memory[origins].ask(oldest_ray);
  memory[slopes].ask(oldest_ray);
  next[ready] = now[Queue::there] & ~leaves;
  const auto oldest = Queue::step<D>(now, next, enters, leaves);
  memory[rays].ask(oldest);
  memory[corners_0].ask(oldest);
  memory[corners_1].ask(oldest);
  memory[corners_2].ask(oldest);
  next[reads_1] = enters;
  next[reader_1] = reader_of(in);
  const auto number = piece<216, triangle_number_bits>(in);
  const auto kept = number_1.width(f);
  next[number_1] = resize(number, kept);
  const CoreBits bits = f;
  const Bit none = is_unread<D>(in, triangle_block, bits.coord);
  next[unread_1] = change_if(kept < Width<triangle_number_bits>(), none,
                             [&](const auto& unread) { return Bit(unread | exceeds<D>(number, kept)); });
}

}  // namespace hitpipe::hls::triangle_queue
