// What int_triangle is given (docs/core.md): a triangle that memory gives, and the ray that wanted it. The
// unit takes a test in some cycles only, so triangles wait in a queue. A ray wants one triangle at a time, so
// the queue has a place for each. When the oldest is there, the words of its ray are asked for; from the next
// cycle on the unit may take the test. A test begins every two cycles at most.
#pragma once

#include "hls/machines/core_ports.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {
namespace triangle_feed {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto number_of(const F& f) { return f.ray * 0_w + Width<triangle_number_bits>(); }
  static constexpr auto corner_of(const F& f) { return f.coord * 3_w; }
  static constexpr auto origins_of(const F& f) { return f.point() * 3_w + 3_w; }
  static constexpr auto slopes_of(const F& f) { return f.direction() * 2_w; }

  using Ray = decltype(format.ray + 0_w);
  using Number = decltype(number_of(format));
  using Coord = decltype(format.coord + 0_w);
  using Point = decltype(format.point());
  using Slope = decltype(format.slope + 1_w);
  using Direction = decltype(format.direction());
};

template <class D, class F>
struct State {
  using W = Widths<F>;
  using bit = typename D::bit;

  IdQueue<D, F> queue;
  bit ready;  ///< the words of the oldest triangle's ray are there
  bit reads;  ///< a triangle has come in the last cycle
  Word<D, typename W::Ray> reader;
  Word<D, typename W::Number> number;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    IdQueue<D, F>::for_each({"used", "oldest", "there"}, bits.ray, self.queue, visit);
    visit(control_field("ready", 1), self.ready);
    visit(control_field("reads_1", 1), self.reads);
    visit(data_field("reader_1", bits.ray), self.reader);
    visit(data_field("number_1", triangle_number_bits), self.number);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;

  NewRay<D, F> fresh;
  Word<D, typename W::Slope> s_a, s_b;
  BlockRead<D, F> read;
  typename D::bit takes;  ///< the unit takes a test in this cycle

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    NewRay<D, F>::for_each(bits, self.fresh, visit);
    visit(data_field("ray_s_a", bits.slope + 1), self.s_a);
    visit(data_field("ray_s_b", bits.slope + 1), self.s_b);
    BlockRead<D, F>::for_each(bits, self.read, visit);
    visit(data_field("unit_takes", 1), self.takes);
  }
};

/// To best_hits, and a test with the names that the unit's operands have.
template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;
  using Point = SignedWord<D, typename W::Point>;
  using Direction = SignedWord<D, typename W::Direction>;
  using Coord = SignedWord<D, typename W::Coord>;

  bit reads;
  Word<D, typename W::Ray> reader;
  Word<D, typename W::Number> number;
  bit begins;
  Word<D, typename W::Ray> ray;
  bit major_y, major_z, back_m;
  Point origin_m, origin_a, origin_b;
  Direction slope_a, slope_b;
  Coord x0, y0, z0, x1, y1, z1, x2, y2, z2;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    visit(data_field("reads", 1), self.reads);
    visit(data_field("read_ray", bits.ray), self.reader);
    visit(data_field("number", triangle_number_bits), self.number);
    visit(data_field("begins", 1), self.begins);
    visit(data_field("test_ray", bits.ray), self.ray);
    visit(data_field("major_y", 1), self.major_y);
    visit(data_field("major_z", 1), self.major_z);
    visit(data_field("back_m", 1), self.back_m);
    visit(data_field("origin_m", bits.point(), true), self.origin_m);
    visit(data_field("origin_a", bits.point(), true), self.origin_a);
    visit(data_field("origin_b", bits.point(), true), self.origin_b);
    visit(data_field("slope_a", bits.direction(), true), self.slope_a);
    visit(data_field("slope_b", bits.direction(), true), self.slope_b);
    const auto coordinate = [&](const char* name, auto& of) {
      visit(data_field(name, bits.coord, true), of);
    };
    coordinate("x0", self.x0);
    coordinate("y0", self.y0);
    coordinate("z0", self.z0);
    coordinate("x1", self.x1);
    coordinate("y1", self.y1);
    coordinate("z1", self.z1);
    coordinate("x2", self.x2);
    coordinate("y2", self.y2);
    coordinate("z2", self.z2);
  }
};

template <class Memory>
struct Memories {
  Memory rays, corners_0, corners_1, corners_2;  ///< the queue
  Memory origins, slopes;                        ///< by ray

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    using W = Widths<CoreBits>;
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

struct TriangleFeed {
  static constexpr const char* name = "triangle_feed";
  static constexpr const char* summary = "gives triangles and their rays to the triangle unit";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = CoreBits;
  using BuiltIn = FormatList<CoreFormat<20, 1, 20, 0, 0, 5>, CoreFormat<20, 1, 20, 0, 0, 7>>;
  template <class D, class F>
  using State = triangle_feed::State<D, F>;
  template <class D, class F>
  using Inputs = triangle_feed::Inputs<D, F>;
  template <class D, class F>
  using Outputs = triangle_feed::Outputs<D, F>;
  template <class Memory>
  using Memories = triangle_feed::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    const auto n = format.coord;
    const auto point = format.point();
    const auto direction = format.direction();
    const auto origins = memories.origins.word(Widths<F>::origins_of(format));
    const auto slopes = memories.slopes.word(Widths<F>::slopes_of(format));
    // The third of three numbers of one width is in the low bits.
    const auto third_of = [](const auto& word, const auto& i, const auto& width) {
      return as_signed(slice(word, width * (i + 1_w) - 1_w, width * i));
    };
    const auto first = memories.corners_0.word(Widths<F>::corner_of(format));
    const auto second = memories.corners_1.word(Widths<F>::corner_of(format));
    const auto third = memories.corners_2.word(Widths<F>::corner_of(format));

    Outputs<D, F> out;
    out.reads = state.reads;
    out.reader = state.reader;
    out.number = state.number;
    out.begins = state.ready;
    out.ray = memories.rays.word(format.ray);
    out.major_y = bit_at(origins, point * 3_w + 2_w);
    out.major_z = bit_at(origins, point * 3_w + 1_w);
    out.back_m = bit_at(origins, point * 3_w);
    out.origin_m = third_of(origins, 2_w, point);
    out.origin_a = third_of(origins, 1_w, point);
    out.origin_b = third_of(origins, 0_w, point);
    out.slope_a = third_of(slopes, 1_w, direction);
    out.slope_b = third_of(slopes, 0_w, direction);
    out.x0 = third_of(first, 2_w, n);
    out.y0 = third_of(first, 1_w, n);
    out.z0 = third_of(first, 0_w, n);
    out.x1 = third_of(second, 2_w, n);
    out.y1 = third_of(second, 1_w, n);
    out.z1 = third_of(second, 0_w, n);
    out.x2 = third_of(third, 2_w, n);
    out.y2 = third_of(third, 1_w, n);
    out.z2 = third_of(third, 0_w, n);
    return out;
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const NewRay<D, F>& fresh = in.fresh;
    const Bit begins = as("ray_begins", fresh.valid & fresh.ready);
    // The unit's slope is divided by the direction's sign along the major axis.
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
    const Bit reads = as("reads_triangle", read.valid & Bit(read.triangle()));
    const auto place = as("place", state.queue.place(format.ray));
    const auto n = format.coord;
    memories.rays.write(reads, place, read.ray());
    memories.corners_0.write(reads, place,
                             cat(cat(read.template coordinate<0>(n), read.template coordinate<1>(n)),
                                 read.template coordinate<2>(n)));
    memories.corners_1.write(reads, place,
                             cat(cat(read.template coordinate<3>(n), read.template coordinate<4>(n)),
                                 read.template coordinate<5>(n)));
    memories.corners_2.write(reads, place,
                             cat(cat(read.template coordinate<6>(n), read.template coordinate<7>(n)),
                                 read.template coordinate<8>(n)));
    const auto oldest_ray = memories.rays.word(format.ray);
    memories.origins.ask(oldest_ray);
    memories.slopes.ask(oldest_ray);
    const Bit taken = as("taken", state.ready & in.takes);
    state.ready = state.queue.there & ~taken;
    const auto oldest = state.queue.step(format.ray, reads, taken);
    memories.rays.ask(oldest);
    memories.corners_0.ask(oldest);
    memories.corners_1.ask(oldest);
    memories.corners_2.ask(oldest);
    state.reads = reads;
    state.reader = read.ray();
    state.number = read.template piece<216, 32>();
  }
};

}  // namespace triangle_feed

using triangle_feed::TriangleFeed;

}  // namespace hls
}  // namespace hitpipe
