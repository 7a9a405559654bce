// What int_major_pair is given (docs/core.md): a record that memory gives, and the ray that wanted it. The
// unit takes a test in every cycle, so no ray waits here. When a record comes, the words of its ray are asked
// for. One cycle later the test begins, and the walker is told where the record's children are.
#pragma once

#include "hls/box/major_format.hpp"
#include "hls/machines/core_ports.hpp"
#include "hls/machines/machine.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/world_format.hpp"

namespace hitpipe {
namespace hls {

/// The format "n+g/pfFaAiI", for example 20+1/11a24i5. The numbers before A are those of
/// hls/box/major_format.hpp.
///   A  bits of a block's number;  I  bits of a ray's number
struct PairFeedBits {
  int coord = 20;     ///< n
  int finer = 1;      ///< g
  int mantissa = 11;  ///< p
  int fraction = 0;   ///< F
  int address = 24;   ///< A
  int ray = 5;        ///< I

  static constexpr FormatField fields[] = {
      {"", "n", WorldBits::min_coord, WorldBits::max_coord},
      {"+", "g", 0, WorldBits::max_finer},
      {"/", "p", MajorBits::min_mantissa, MajorBits::max_mantissa},
      {"f", "F", MajorBits::min_fraction, MajorBits::max_fraction, nullptr, true},
      {"a", "A", 4, 32},
      {"i", "I", 1, 8}};
  static constexpr const char* condition = "a format of int_major_pair";
  static constexpr const char* type = "PairFeedFormat";

  /// Of the unit. No port of it depends on the bits of a slope.
  constexpr MajorBits boxes() const { return {coord, finer, mantissa, fraction, WorldBits::min_slope}; }
  constexpr int point() const { return boxes().point(); }
  constexpr int exponent() const { return boxes().exponent(); }
  constexpr int length() const { return boxes().length(); }
  constexpr int rays() const { return power_of_two(ray); }
  constexpr bool valid() const { return boxes().valid(); }
  friend constexpr bool operator==(const PairFeedBits& a, const PairFeedBits& b) {
    return a.boxes() == b.boxes() && a.address == b.address && a.ray == b.ray;
  }
};
template <int N, int G, int P, int Fraction, int Address, int Ray>
struct PairFeedFormat {
  static constexpr PairFeedBits bits{N, G, P, Fraction, Address, Ray};
  static_assert(bits.valid(), "there is no such format n+g/pfFaAiI");
  Width<N> coord{};
  Width<P> mantissa{};
  Width<Address> address{};
  Width<Ray> ray{};
  constexpr Width<bits.point()> point() const { return {}; }
  constexpr Width<bits.exponent()> exponent() const { return {}; }
  constexpr Width<bits.length()> length() const { return {}; }
  constexpr operator PairFeedBits() const { return bits; }
};

namespace pair_feed {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto count_of(const F& f) { return f.ray * 0_w + Width<child_count_bits>(); }
  static constexpr auto origins_of(const F& f) { return f.point() * 3_w + 5_w; }
  static constexpr auto bounds_of(const F& f) { return f.mantissa * 2_w + f.exponent(); }

  using Ray = decltype(format.ray + 0_w);
  using Address = decltype(format.address + 0_w);
  using Count = decltype(count_of(format));
  using Plane = decltype(format.coord + 0_w);
  using Point = decltype(format.point());
  using Mantissa = decltype(format.mantissa + 0_w);
  using Exponent = decltype(format.exponent());
  using Length = decltype(format.length());
};

/// What a record says of its boxes.
template <class D, class F>
struct Planes {
  using Plane = SignedWord<D, typename Widths<F>::Plane>;
  using bit = typename D::bit;

  Plane xmin, ymin, zmin, xmax, ymax, zmax;
  bit own_xmin, own_ymin, own_zmin, own_xmax, own_ymax, own_zmax;
};

template <class D, class F>
struct State {
  using W = Widths<F>;

  typename D::bit there;  ///< a record has come in the last cycle
  Word<D, typename W::Ray> ray;
  Planes<D, F> planes;
  Word<D, typename W::Address> block;
  Word<D, typename W::Count> count_0, count_1;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const PairFeedBits bits = format;
    visit(control_field("there_1", 1), self.there);
    visit(data_field("ray_1", bits.ray), self.ray);
    const auto plane = [&](const char* name, auto& of) { visit(data_field(name, bits.coord, true), of); };
    plane("xmin_1", self.planes.xmin);
    plane("ymin_1", self.planes.ymin);
    plane("zmin_1", self.planes.zmin);
    plane("xmax_1", self.planes.xmax);
    plane("ymax_1", self.planes.ymax);
    plane("zmax_1", self.planes.zmax);
    visit(data_field("own_xmin_1", 1), self.planes.own_xmin);
    visit(data_field("own_ymin_1", 1), self.planes.own_ymin);
    visit(data_field("own_zmin_1", 1), self.planes.own_zmin);
    visit(data_field("own_xmax_1", 1), self.planes.own_xmax);
    visit(data_field("own_ymax_1", 1), self.planes.own_ymax);
    visit(data_field("own_zmax_1", 1), self.planes.own_zmax);
    visit(data_field("block_1", bits.address), self.block);
    visit(data_field("count_0_1", child_count_bits), self.count_0);
    visit(data_field("count_1_1", child_count_bits), self.count_1);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;

  NewRay<D, F> fresh;
  Word<D, typename W::Mantissa> floor_a, ceil_a, floor_b, ceil_b;
  Word<D, typename W::Exponent> exp_a, exp_b;
  typename D::bit goes;  ///< the walker's: a ray wants a record, where it is between these distances
  Word<D, typename W::Ray> goer;
  Word<D, typename W::Length> near, far;
  BlockRead<D, F> read;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const PairFeedBits bits = format;
    NewRay<D, F>::for_each(bits, self.fresh, visit);
    visit(data_field("ray_floor_a", bits.mantissa), self.floor_a);
    visit(data_field("ray_ceil_a", bits.mantissa), self.ceil_a);
    visit(data_field("ray_exp_a", bits.exponent()), self.exp_a);
    visit(data_field("ray_floor_b", bits.mantissa), self.floor_b);
    visit(data_field("ray_ceil_b", bits.mantissa), self.ceil_b);
    visit(data_field("ray_exp_b", bits.exponent()), self.exp_b);
    visit(data_field("go", 1), self.goes);
    visit(data_field("goer", bits.ray), self.goer);
    visit(data_field("enters_at", bits.length()), self.near);
    visit(data_field("leaves_at", bits.length()), self.far);
    BlockRead<D, F>::for_each(bits, self.read, visit);
  }
};

/// To the walker, and a test with the names that the unit's operands have.
template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit there;
  Word<D, typename W::Ray> ray;
  Word<D, typename W::Address> block;
  Word<D, typename W::Count> count_0, count_1;
  bit major_y, major_z, back_m, back_a, back_b;
  SignedWord<D, typename W::Point> origin_m, origin_a, origin_b;
  Word<D, typename W::Mantissa> floor_a, ceil_a, floor_b, ceil_b;
  Word<D, typename W::Exponent> exp_a, exp_b;
  SignedWord<D, typename W::Length> near, far;
  Planes<D, F> planes;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const PairFeedBits bits = format;
    visit(data_field("begins", 1), self.there);
    visit(data_field("test_ray", bits.ray), self.ray);
    visit(data_field("block", bits.address), self.block);
    visit(data_field("count_0", child_count_bits), self.count_0);
    visit(data_field("count_1", child_count_bits), self.count_1);
    visit(data_field("major_y", 1), self.major_y);
    visit(data_field("major_z", 1), self.major_z);
    visit(data_field("back_m", 1), self.back_m);
    visit(data_field("back_a", 1), self.back_a);
    visit(data_field("back_b", 1), self.back_b);
    visit(data_field("origin_m", bits.point(), true), self.origin_m);
    visit(data_field("origin_a", bits.point(), true), self.origin_a);
    visit(data_field("origin_b", bits.point(), true), self.origin_b);
    visit(data_field("floor_a", bits.mantissa), self.floor_a);
    visit(data_field("ceil_a", bits.mantissa), self.ceil_a);
    visit(data_field("floor_b", bits.mantissa), self.floor_b);
    visit(data_field("ceil_b", bits.mantissa), self.ceil_b);
    visit(data_field("exp_a", bits.exponent()), self.exp_a);
    visit(data_field("exp_b", bits.exponent()), self.exp_b);
    visit(data_field("parent_near", bits.length(), true), self.near);
    visit(data_field("parent_far", bits.length(), true), self.far);
    const auto plane = [&](const char* name, auto& of) { visit(data_field(name, bits.coord, true), of); };
    plane("xmin", self.planes.xmin);
    plane("ymin", self.planes.ymin);
    plane("zmin", self.planes.zmin);
    plane("xmax", self.planes.xmax);
    plane("ymax", self.planes.ymax);
    plane("zmax", self.planes.zmax);
    visit(data_field("own_xmin", 1), self.planes.own_xmin);
    visit(data_field("own_ymin", 1), self.planes.own_ymin);
    visit(data_field("own_zmin", 1), self.planes.own_zmin);
    visit(data_field("own_xmax", 1), self.planes.own_xmax);
    visit(data_field("own_ymax", 1), self.planes.own_ymax);
    visit(data_field("own_zmax", 1), self.planes.own_zmax);
  }
};

/// By ray.
template <class Memory>
struct Memories {
  Memory origins;             ///< axes, signs and origin
  Memory bounds_a, bounds_b;  ///< of reciprocals
  Memory intervals;           ///< where it is in the record that it wants

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const PairFeedBits bits = format;
    using W = Widths<PairFeedBits>;
    const auto memory = [&](const char* name, int width, Memory& of) {
      visit(MemoryShape{name, bits.rays(), width, MemoryKind::block}, of);
    };
    memory("origins", W::origins_of(bits), self.origins);
    memory("bounds_a", W::bounds_of(bits), self.bounds_a);
    memory("bounds_b", W::bounds_of(bits), self.bounds_b);
    memory("intervals", 2 * bits.length(), self.intervals);
  }
};

struct PairFeed {
  static constexpr const char* name = "pair_feed";
  static constexpr const char* summary = "gives records and their rays to the unit for two boxes";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = PairFeedBits;
  using BuiltIn = FormatList<PairFeedFormat<20, 1, 11, 0, 24, 5>, PairFeedFormat<20, 1, 11, 0, 24, 7>>;
  template <class D, class F>
  using State = pair_feed::State<D, F>;
  template <class D, class F>
  using Inputs = pair_feed::Inputs<D, F>;
  template <class D, class F>
  using Outputs = pair_feed::Outputs<D, F>;
  template <class Memory>
  using Memories = pair_feed::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    const auto point = format.point();
    const auto p = format.mantissa;
    const auto e = format.exponent();
    const auto length = format.length();
    const auto origins = memories.origins.word(Widths<F>::origins_of(format));
    const auto bounds_a = memories.bounds_a.word(Widths<F>::bounds_of(format));
    const auto bounds_b = memories.bounds_b.word(Widths<F>::bounds_of(format));
    const auto interval = memories.intervals.word(length * 2_w);

    Outputs<D, F> out;
    out.there = state.there;
    out.ray = state.ray;
    out.block = state.block;
    out.count_0 = state.count_0;
    out.count_1 = state.count_1;
    const auto flag = [&](const auto& i) { return bit_at(origins, point * 3_w + i); };
    out.major_y = flag(4_w);
    out.major_z = flag(3_w);
    out.back_m = flag(2_w);
    out.back_a = flag(1_w);
    out.back_b = flag(0_w);
    out.origin_m = as_signed(slice(origins, point * 3_w - 1_w, point * 2_w));
    out.origin_a = as_signed(slice(origins, point * 2_w - 1_w, point));
    out.origin_b = as_signed(slice(origins, point - 1_w, 0_w));
    out.floor_a = slice(bounds_a, e + p * 2_w - 1_w, e + p);
    out.ceil_a = slice(bounds_a, e + p - 1_w, e);
    out.exp_a = slice(bounds_a, e - 1_w, 0_w);
    out.floor_b = slice(bounds_b, e + p * 2_w - 1_w, e + p);
    out.ceil_b = slice(bounds_b, e + p - 1_w, e);
    out.exp_b = slice(bounds_b, e - 1_w, 0_w);
    out.near = as_signed(slice(interval, length * 2_w - 1_w, length));
    out.far = as_signed(slice(interval, length - 1_w, 0_w));
    out.planes = state.planes;
    return out;
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const NewRay<D, F>& fresh = in.fresh;
    const Bit begins = as("ray_begins", fresh.valid & fresh.ready);
    // The unit's origin is -x, or x + 1 on an axis that the ray goes back along.
    const auto negated = [&](const auto& x, const Bit& back) {
      const auto flipped = x ^ as_signed(spread(Bit(~back), format.point()));
      return as_unsigned(resize(flipped + as_signed(D::lit(1, 2_w)), format.point()));
    };
    const auto origins =
        cat(cat(negated(fresh.origin_m, fresh.back_m), negated(fresh.origin_a, fresh.back_a)),
            negated(fresh.origin_b, fresh.back_b));
    const auto flags =
        cat(cat(cat(fresh.major_y, fresh.major_z), fresh.back_m), cat(fresh.back_a, fresh.back_b));
    memories.origins.write(begins, fresh.at, cat(flags, origins));
    memories.bounds_a.write(begins, fresh.at, cat(cat(in.floor_a, in.ceil_a), in.exp_a));
    memories.bounds_b.write(begins, fresh.at, cat(cat(in.floor_b, in.ceil_b), in.exp_b));
    memories.intervals.write(in.goes, in.goer, cat(in.near, in.far));

    const BlockRead<D, F>& read = in.read;
    const auto ray = read.ray();
    memories.origins.ask(ray);
    memories.bounds_a.ask(ray);
    memories.bounds_b.ask(ray);
    memories.intervals.ask(ray);
    state.there = read.valid & ~Bit(read.triangle());
    state.ray = ray;
    const auto n = format.coord;
    state.planes = {
        read.template coordinate<0>(n), read.template coordinate<1>(n), read.template coordinate<2>(n),
        read.template coordinate<3>(n), read.template coordinate<4>(n), read.template coordinate<5>(n),
        read.template piece<144, 1>(),  read.template piece<145, 1>(),  read.template piece<146, 1>(),
        read.template piece<147, 1>(),  read.template piece<148, 1>(),  read.template piece<149, 1>()};
    state.block = resize(read.template piece<160, 32>(), format.address);
    state.count_0 = read.template piece<192, child_count_bits>();
    state.count_1 = read.template piece<200, child_count_bits>();
  }
};

}  // namespace pair_feed

using pair_feed::PairFeed;

}  // namespace hls
}  // namespace hitpipe
