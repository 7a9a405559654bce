// What int_triangle is given (docs/core.md): a triangle that memory gives, and the ray that wanted it. The
// unit takes a test in some cycles only. Till then triangles wait. A test begins every two cycles at most.
#pragma once

#include "hls/machines/machine.hpp"
#include "hls/machines/triangle_queue.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {
namespace triangle_feed {

template <class D, class F>
struct Inputs {
  TriangleInputs<D, F> triangle;
  typename D::bit takes;  ///< the unit takes a test in this cycle

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& bits, Self& self, Visit&& visit) {
    TriangleInputs<D, F>::for_each(bits, self.triangle, visit);
    visit(data_field("unit_takes", 1), self.takes);
  }
};

/// To best_hits, and a test with the names that the unit's operands have.
template <class D, class F>
struct Outputs {
  static constexpr F format{};
  using W = TriangleWidths<F>;
  using bit = typename D::bit;
  using Point = SignedWord<D, decltype(format.point())>;
  using Direction = SignedWord<D, decltype(format.direction())>;
  using Coord = SignedWord<D, decltype(format.coord + 0_w)>;

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
  static constexpr void for_each(const Format& of, Self& self, Visit&& visit) {
    const CoreBits bits = of;
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
    const auto coordinate = [&](const char* name, auto& value) {
      visit(data_field(name, bits.coord, true), value);
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

struct TriangleFeed {
  static constexpr const char* name = "triangle_feed";
  static constexpr const char* summary = "gives triangles and their rays to the triangle unit";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = CoreBits;
  using BuiltIn = FormatList<CoreFormat<20, 1, 20, 0, 0, 5>, CoreFormat<20, 1, 20, 0, 0, 7>>;
  template <class D, class F>
  using State = TriangleQueue<D, F>;
  template <class D, class F>
  using Inputs = triangle_feed::Inputs<D, F>;
  template <class D, class F>
  using Outputs = triangle_feed::Outputs<D, F>;
  template <class Memory>
  using Memories = TriangleMemories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    const auto test = TriangleQueue<D, F>::oldest(format, memories);
    return {state.reads,   state.reader, state.number, state.ready,   memories.rays.word(format.ray),
            test.major_y,  test.major_z, test.back_m,  test.origin_m, test.origin_a,
            test.origin_b, test.slope_a, test.slope_b, test.x0,       test.y0,
            test.z0,       test.x1,      test.y1,      test.z1,       test.x2,
            test.y2,       test.z2};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    const typename D::bit taken = as("taken", state.ready & in.takes);
    state.step(format, in.triangle, taken, memories);
  }
};

}  // namespace triangle_feed

using triangle_feed::TriangleFeed;

}  // namespace hls
}  // namespace hitpipe
