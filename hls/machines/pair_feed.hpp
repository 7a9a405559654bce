// What int_major_pair is given (docs/core.md): a record that memory gives, and the ray that wanted it. The
// unit takes a test in every cycle, so no ray waits here. When a record comes, the words of its ray are asked
// for. One cycle later the test begins, and the walker is told where the record's children are.
#pragma once

#include "hls/box/major_format.hpp"
#include "hls/machines/core_ports.hpp"
#include "hls/machines/memory.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/world/world_format.hpp"

namespace hitpipe::hls {

/// The format "n+g/pfFaAiI", for example 20+1/11a24i5. The numbers before A are those of
/// hls/box/major_format.hpp.
struct PairFeedBits {
  int coord = 20;     ///< n
  int finer = 1;      ///< g
  int mantissa = 11;  ///< p
  int fraction = 0;   ///< F
  int address = 24;   ///< A: bits of a block's number
  int ray = 5;        ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {
      {"", "n", WorldBits::min_coord, WorldBits::max_coord},
      {"+", "g", 0, WorldBits::max_finer},
      {"/", "p", MajorBits::min_mantissa, MajorBits::max_mantissa},
      {"f", "F", MajorBits::min_fraction, MajorBits::max_fraction, nullptr, true},
      {"a", "A", 4, 32},
      {"i", "I", 1, 8}};
  static constexpr const char* condition = "a format of int_major_pair";

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

namespace pair_feed {

using namespace core_ports;

constexpr Data<"ray_floor_a", &PairFeedBits::mantissa> ray_floor_a;
constexpr Data<"ray_ceil_a", &PairFeedBits::mantissa> ray_ceil_a;
constexpr Data<"ray_exp_a", &PairFeedBits::exponent> ray_exp_a;
constexpr Data<"ray_floor_b", &PairFeedBits::mantissa> ray_floor_b;
constexpr Data<"ray_ceil_b", &PairFeedBits::mantissa> ray_ceil_b;
constexpr Data<"ray_exp_b", &PairFeedBits::exponent> ray_exp_b;
constexpr Data<"go"> go;  // the walker's: a ray wants a record, where it is between these distances
constexpr Data<"goer", &PairFeedBits::ray> goer;
constexpr Data<"enters_at", &PairFeedBits::length> enters_at;
constexpr Data<"leaves_at", &PairFeedBits::length> leaves_at;

constexpr Data<"begins"> begins;  // to the walker
constexpr Data<"test_ray", &PairFeedBits::ray> test_ray;
constexpr Data<"block", &PairFeedBits::address> block;
constexpr Data<"count_0", child_count_bits> count_0;
constexpr Data<"count_1", child_count_bits> count_1;
constexpr Data<"major_y"> major_y;  // a test, with the names that the unit's operands have
constexpr Data<"major_z"> major_z;
constexpr Data<"back_m"> back_m;
constexpr Data<"back_a"> back_a;
constexpr Data<"back_b"> back_b;
constexpr SignedData<"origin_m", &PairFeedBits::point> origin_m;
constexpr SignedData<"origin_a", &PairFeedBits::point> origin_a;
constexpr SignedData<"origin_b", &PairFeedBits::point> origin_b;
constexpr Data<"floor_a", &PairFeedBits::mantissa> floor_a;
constexpr Data<"ceil_a", &PairFeedBits::mantissa> ceil_a;
constexpr Data<"floor_b", &PairFeedBits::mantissa> floor_b;
constexpr Data<"ceil_b", &PairFeedBits::mantissa> ceil_b;
constexpr Data<"exp_a", &PairFeedBits::exponent> exp_a;
constexpr Data<"exp_b", &PairFeedBits::exponent> exp_b;
constexpr SignedData<"parent_near", &PairFeedBits::length> parent_near;
constexpr SignedData<"parent_far", &PairFeedBits::length> parent_far;
constexpr SignedData<"xmin", &PairFeedBits::coord> xmin;
constexpr SignedData<"ymin", &PairFeedBits::coord> ymin;
constexpr SignedData<"zmin", &PairFeedBits::coord> zmin;
constexpr SignedData<"xmax", &PairFeedBits::coord> xmax;
constexpr SignedData<"ymax", &PairFeedBits::coord> ymax;
constexpr SignedData<"zmax", &PairFeedBits::coord> zmax;
constexpr Data<"own_xmin"> own_xmin;
constexpr Data<"own_ymin"> own_ymin;
constexpr Data<"own_zmin"> own_zmin;
constexpr Data<"own_xmax"> own_xmax;
constexpr Data<"own_ymax"> own_ymax;
constexpr Data<"own_zmax"> own_zmax;

constexpr Control<"there_1"> there_1;  // a record has come in the last cycle
constexpr Data<"ray_1", &PairFeedBits::ray> ray_1;
constexpr SignedData<"xmin_1", &PairFeedBits::coord> xmin_1;
constexpr SignedData<"ymin_1", &PairFeedBits::coord> ymin_1;
constexpr SignedData<"zmin_1", &PairFeedBits::coord> zmin_1;
constexpr SignedData<"xmax_1", &PairFeedBits::coord> xmax_1;
constexpr SignedData<"ymax_1", &PairFeedBits::coord> ymax_1;
constexpr SignedData<"zmax_1", &PairFeedBits::coord> zmax_1;
constexpr Data<"own_xmin_1"> own_xmin_1;
constexpr Data<"own_ymin_1"> own_ymin_1;
constexpr Data<"own_zmin_1"> own_zmin_1;
constexpr Data<"own_xmax_1"> own_xmax_1;
constexpr Data<"own_ymax_1"> own_ymax_1;
constexpr Data<"own_zmax_1"> own_zmax_1;
constexpr Data<"block_1", &PairFeedBits::address> block_1;
constexpr Data<"count_0_1", child_count_bits> count_0_1;
constexpr Data<"count_1_1", child_count_bits> count_1_1;

// By ray.
struct Origins : List<major_y, major_z, back_m, back_a, back_b, origin_m, origin_a, origin_b> {};
struct BoundsA : List<floor_a, ceil_a, exp_a> {};
struct BoundsB : List<floor_b, ceil_b, exp_b> {};
struct Interval : List<parent_near, parent_far> {};
constexpr BlockOf<"origins", &PairFeedBits::rays, Origins> origins;
constexpr BlockOf<"bounds_a", &PairFeedBits::rays, BoundsA> bounds_a;  // of reciprocals
constexpr BlockOf<"bounds_b", &PairFeedBits::rays, BoundsB> bounds_b;
constexpr BlockOf<"intervals", &PairFeedBits::rays, Interval>
    intervals;  // where it is in the record that it wants

struct PairFeed {
  static constexpr const char* name = "pair_feed";
  static constexpr const char* summary = "gives records and their rays to the unit for two boxes";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = PairFeedBits;
  using BuiltIn =
      FormatList<Fixed<PairFeedBits{20, 1, 11, 0, 24, 5}>, Fixed<PairFeedBits{20, 1, 11, 0, 24, 7}>>;
  struct In : Join<NewRay,
                   List<ray_floor_a, ray_ceil_a, ray_exp_a, ray_floor_b, ray_ceil_b, ray_exp_b, go, goer,
                        enters_at, leaves_at>,
                   BlockRead> {};
  struct Out
      : List<begins, test_ray, block, count_0, count_1, major_y, major_z, back_m, back_a, back_b, origin_m,
             origin_a, origin_b, floor_a, ceil_a, floor_b, ceil_b, exp_a, exp_b, parent_near, parent_far,
             xmin, ymin, zmin, xmax, ymax, zmax, own_xmin, own_ymin, own_zmin, own_xmax, own_ymax, own_zmax> {
  };
  struct State : List<there_1, ray_1, xmin_1, ymin_1, zmin_1, xmax_1, ymax_1, zmax_1, own_xmin_1, own_ymin_1,
                      own_zmin_1, own_xmax_1, own_ymax_1, own_zmax_1, block_1, count_0_1, count_1_1> {};
  struct Memory : List<origins, bounds_a, bounds_b, intervals> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    out[begins] = now[there_1];
    out[test_ray] = now[ray_1];
    out[block] = now[block_1];
    out[count_0] = now[count_0_1];
    out[count_1] = now[count_1_1];
    out.copy(memory[origins].word());
    out.copy(memory[bounds_a].word());
    out.copy(memory[bounds_b].word());
    out.copy(memory[intervals].word());
    out[xmin] = now[xmin_1];
    out[ymin] = now[ymin_1];
    out[zmin] = now[zmin_1];
    out[xmax] = now[xmax_1];
    out[ymax] = now[ymax_1];
    out[zmax] = now[zmax_1];
    out[own_xmin] = now[own_xmin_1];
    out[own_ymin] = now[own_ymin_1];
    out[own_zmin] = now[own_zmin_1];
    out[own_xmax] = now[own_xmax_1];
    out[own_ymax] = now[own_ymax_1];
    out[own_zmax] = now[own_zmax_1];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& /*now*/, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit new_ray = as("ray_begins", in[ray_valid] & in[ray_ready]);
    // The unit's origin is -x, or x + 1 on an axis that the ray goes back along.
    const auto negated = [&](const auto& x, const Bit& back) {
      const auto flipped = x ^ as_signed(spread(Bit(~back), width_of(x)));
      return as_unsigned(resize(flipped + as_signed(D::lit(1, 2_w)), width_of(x)));
    };
    const auto flags = cat(in[ray_major_y], in[ray_major_z], in[ray_back_m], in[ray_back_a], in[ray_back_b]);
    const auto origin =
        cat(negated(in[ray_origin_m], in[ray_back_m]), negated(in[ray_origin_a], in[ray_back_a]),
            negated(in[ray_origin_b], in[ray_back_b]));
    memory[origins].write(new_ray, in[begun_at], cat(flags, origin));
    memory[bounds_a].write(new_ray, in[begun_at], in[ray_floor_a], in[ray_ceil_a], in[ray_exp_a]);
    memory[bounds_b].write(new_ray, in[begun_at], in[ray_floor_b], in[ray_ceil_b], in[ray_exp_b]);
    memory[intervals].write(in[go], in[goer], in[enters_at], in[leaves_at]);

    const auto ray = read_ray(in);
    memory[origins].ask(ray);
    memory[bounds_a].ask(ray);
    memory[bounds_b].ask(ray);
    memory[intervals].ask(ray);
    next[there_1] = in[read_valid] & ~Bit(reads_triangle(in));
    next[ray_1] = ray;
    const auto n = xmin.width(f);
    next[xmin_1] = coordinate<0>(in, n);
    next[ymin_1] = coordinate<1>(in, n);
    next[zmin_1] = coordinate<2>(in, n);
    next[xmax_1] = coordinate<3>(in, n);
    next[ymax_1] = coordinate<4>(in, n);
    next[zmax_1] = coordinate<5>(in, n);
    next[own_xmin_1] = piece<144, 1>(in);
    next[own_ymin_1] = piece<145, 1>(in);
    next[own_zmin_1] = piece<146, 1>(in);
    next[own_xmax_1] = piece<147, 1>(in);
    next[own_ymax_1] = piece<148, 1>(in);
    next[own_zmax_1] = piece<149, 1>(in);
    next[block_1] = resize(piece<160, 32>(in), block.width(f));
    next[count_0_1] = piece<192, child_count_bits>(in);
    next[count_1_1] = piece<200, child_count_bits>(in);
  }
};

}  // namespace pair_feed

using pair_feed::PairFeed;

}  // namespace hitpipe::hls
