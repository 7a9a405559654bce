// Triangles that memory gives, and the rays that wanted them (docs/core.md). It is in triangle_feed and in
// serial_triangle. A test takes longer than a read, so triangles wait in a queue. A ray wants one triangle at
// a time, so the queue has a place for each. When the oldest is there, the words of its ray are asked for,
// and from the next cycle on it may be tested.
#pragma once

#include "hls/machines/core_ports.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {

/// Widths of the words as types, in a format.
template <class F>
struct TriangleWidths {
  static constexpr F format{};
  static constexpr auto number_of(const F& f) { return f.ray * 0_w + Width<triangle_number_bits>(); }
  static constexpr auto corner_of(const F& f) { return f.coord * 3_w; }
  static constexpr auto origins_of(const F& f) { return f.point() * 3_w + 3_w; }
  static constexpr auto slopes_of(const F& f) { return f.direction() * 2_w; }

  using Ray = decltype(format.ray + 0_w);
  using Number = decltype(number_of(format));
  using Slope = decltype(format.slope + 1_w);
};

/// A new ray, and a block that memory gives, which may be a triangle.
template <class D, class F>
struct TriangleInputs {
  NewRay<D, F> fresh;
  Word<D, typename TriangleWidths<F>::Slope> s_a, s_b;
  BlockRead<D, F> read;

  template <class Self, class Visit>
  static constexpr void for_each(const CoreBits& bits, Self& self, Visit&& visit) {
    NewRay<D, F>::for_each(bits, self.fresh, visit);
    visit(data_field("ray_s_a", bits.slope + 1), self.s_a);
    visit(data_field("ray_s_b", bits.slope + 1), self.s_b);
    BlockRead<D, F>::for_each(bits, self.read, visit);
  }
};

template <class Memory>
struct TriangleMemories {
  Memory rays, corners_0, corners_1, corners_2;  ///< the queue
  Memory origins, slopes;                        ///< by ray

  template <class Self, class Visit>
  static constexpr void for_each(const CoreBits& bits, Self& self, Visit&& visit) {
    using W = TriangleWidths<CoreBits>;
    const auto memory = [&](const char* name, int width, Memory& of) {
      visit(MemoryShape{name, bits.rays(), width, MemoryKind::block}, of);
    };
    memory("rays", bits.ray, self.rays);
    memory("corners_0", W::corner_of(bits), self.corners_0);
    memory("corners_1", W::corner_of(bits), self.corners_1);
    memory("corners_2", W::corner_of(bits), self.corners_2);
    memory("origins", W::origins_of(bits), self.origins);
    memory("slopes", W::slopes_of(bits), self.slopes);
  }
};

/// The oldest triangle by axis, and its ray by ray axis.
template <class Corner, class Point, class Direction, class Bit>
struct WaitingTriangle {
  Bit major_y, major_z, back_m;
  Point origin_m, origin_a, origin_b;
  Direction slope_a, slope_b;  ///< divided by the direction's sign on the major axis
  Corner x0, y0, z0, x1, y1, z1, x2, y2, z2;
};

template <class D, class F>
struct TriangleQueue {
  using W = TriangleWidths<F>;
  using Bit = typename D::bit;

  IdQueue<D, F> queue;
  Bit ready;  ///< the words of the oldest triangle's ray are there
  Bit reads;  ///< a triangle has come in the last cycle
  Word<D, typename W::Ray> reader;
  Word<D, typename W::Number> number;

  template <class Self, class Visit>
  static constexpr void for_each(const CoreBits& bits, Self& self, Visit&& visit) {
    IdQueue<D, F>::for_each({"used", "oldest", "there"}, bits.ray, self.queue, visit);
    visit(control_field("ready", 1), self.ready);
    visit(control_field("reads_1", 1), self.reads);
    visit(data_field("reader_1", bits.ray), self.reader);
    visit(data_field("number_1", triangle_number_bits), self.number);
  }

  /// Means something if `ready` is 1.
  template <class Memory>
  static constexpr auto oldest(const F& format, TriangleMemories<Memory>& memories) {
    const auto origins = memories.origins.word(W::origins_of(format));
    const auto slopes = memories.slopes.word(W::slopes_of(format));
    // The third of three numbers of one width is in the low bits.
    const auto third_of = [](const auto& word, const auto& i, const auto& width) {
      return as_signed(slice(word, width * (i + 1_w) - 1_w, width * i));
    };
    const auto first = memories.corners_0.word(W::corner_of(format));
    const auto second = memories.corners_1.word(W::corner_of(format));
    const auto third = memories.corners_2.word(W::corner_of(format));
    const auto n = format.coord;
    const auto point = format.point();
    const auto direction = format.direction();
    using Point = decltype(third_of(origins, 2_w, point));
    using Direction = decltype(third_of(slopes, 1_w, direction));
    using Corner = decltype(third_of(first, 2_w, n));
    return WaitingTriangle<Corner, Point, Direction, Bit>{bit_at(origins, point * 3_w + 2_w),
                                                          bit_at(origins, point * 3_w + 1_w),
                                                          bit_at(origins, point * 3_w),
                                                          third_of(origins, 2_w, point),
                                                          third_of(origins, 1_w, point),
                                                          third_of(origins, 0_w, point),
                                                          third_of(slopes, 1_w, direction),
                                                          third_of(slopes, 0_w, direction),
                                                          third_of(first, 2_w, n),
                                                          third_of(first, 1_w, n),
                                                          third_of(first, 0_w, n),
                                                          third_of(second, 2_w, n),
                                                          third_of(second, 1_w, n),
                                                          third_of(second, 0_w, n),
                                                          third_of(third, 2_w, n),
                                                          third_of(third, 1_w, n),
                                                          third_of(third, 0_w, n)};
  }

  /// One cycle. The oldest leaves if `leaves` is 1; only one that is ready may leave.
  template <class Memory>
  constexpr void step(const F& format, const TriangleInputs<D, F>& in, const Bit& leaves,
                      TriangleMemories<Memory>& memories) {
    const NewRay<D, F>& fresh = in.fresh;
    const Bit begins = as("ray_begins", fresh.valid & fresh.ready);
    const auto slope = [&](const auto& size, const Bit& back) {
      const Bit negative = back ^ fresh.back_m;
      const auto flipped = resize(size, format.direction()) ^ spread(negative, format.direction());
      return as_unsigned(resize(flipped + negative, format.direction()));
    };
    memories.slopes.write(begins, fresh.at, cat(slope(in.s_a, fresh.back_a), slope(in.s_b, fresh.back_b)));
    memories.origins.write(begins, fresh.at,
                           cat(cat(cat(fresh.major_y, fresh.major_z), fresh.back_m),
                               cat(cat(fresh.origin_m, fresh.origin_a), fresh.origin_b)));

    const BlockRead<D, F>& read = in.read;
    const Bit enters = as("reads_triangle", read.valid & Bit(read.triangle()));
    const auto place = as("place", queue.place(format.ray));
    const auto n = format.coord;
    memories.rays.write(enters, place, read.ray());
    memories.corners_0.write(enters, place,
                             cat(cat(read.template coordinate<0>(n), read.template coordinate<1>(n)),
                                 read.template coordinate<2>(n)));
    memories.corners_1.write(enters, place,
                             cat(cat(read.template coordinate<3>(n), read.template coordinate<4>(n)),
                                 read.template coordinate<5>(n)));
    memories.corners_2.write(enters, place,
                             cat(cat(read.template coordinate<6>(n), read.template coordinate<7>(n)),
                                 read.template coordinate<8>(n)));
    const auto oldest_ray = memories.rays.word(format.ray);
    memories.origins.ask(oldest_ray);
    memories.slopes.ask(oldest_ray);
    ready = queue.there & ~leaves;
    const auto oldest = queue.step(format.ray, enters, leaves);
    memories.rays.ask(oldest);
    memories.corners_0.ask(oldest);
    memories.corners_1.ask(oldest);
    memories.corners_2.ask(oldest);
    reads = enters;
    reader = read.ray();
    number = read.template piece<216, 32>();
  }
};

}  // namespace hls
}  // namespace hitpipe
