// What int_major_pair is given (docs/core.md): a record that memory gives, and the ray that wanted it. The
// unit takes a test in every cycle, so no ray waits here. When a record comes, the words of its ray are asked
// for. One cycle later the test begins, and the walker is told where the record's children are.
#pragma once

#include "hls/box/major_format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"
#include "hls/num/levels.hpp"
#include "hls/world/world_format.hpp"

namespace hitpipe::hls {

/// The format "n+g/pfFaAiIeE", for example 20+1/11a24i5. The numbers before A are those of
/// hls/box/major_format.hpp.
struct PairFeedBits {
  int coord = 20;     ///< n
  int finer = 1;      ///< g
  int mantissa = 11;  ///< p
  int fraction = 0;   ///< F
  int address = 24;   ///< A: bits of a block's number
  int ray = 5;        ///< I: bits of a ray's number
  int leaf =
      child_count_bits;  ///< E: bits of the number of triangles in a leaf; not written: those of an image

  static constexpr FormatField fields[] = {
      {"", "n", WorldBits::min_coord, WorldBits::max_coord},
      {"+", "g", 0, WorldBits::max_finer},
      {"/", "p", MajorBits::min_mantissa, MajorBits::max_mantissa},
      {"f", "F", MajorBits::min_fraction, MajorBits::max_fraction, nullptr, true},
      {"a", "A", 4, 32},
      {"i", "I", 1, 8},
      {"e", "E", 2, child_count_bits, nullptr, true}};
  static constexpr const char* condition = "a format of int_major_pair";

  /// Of the unit. No port of it depends on the bits of a slope.
  constexpr MajorBits boxes() const { return {coord, finer, mantissa, fraction, WorldBits::min_slope}; }
  constexpr int point() const { return boxes().point(); }
  constexpr int exponent() const { return boxes().exponent(); }
  constexpr int box() const { return boxes().length(); }
  constexpr int rays() const { return power_of_two(ray); }
  constexpr bool valid() const { return boxes().valid(); }
  friend constexpr bool operator==(const PairFeedBits& a, const PairFeedBits& b) {
    return a.boxes() == b.boxes() && a.address == b.address && a.ray == b.ray && a.leaf == b.leaf;
  }
};

namespace pair_feed {

using namespace channels;

inline constexpr auto coord_bits = [](const PairFeedBits& format) { return format.coord; };

// A test, with the names that the unit's operands have.
constexpr Data<"major_y"> major_y;
constexpr Data<"major_z"> major_z;
constexpr Data<"back_m"> back_m;
constexpr Data<"back_a"> back_a;
constexpr Data<"back_b"> back_b;
constexpr SignedData<"origin_m", point_bits> origin_m;
constexpr SignedData<"origin_a", point_bits> origin_a;
constexpr SignedData<"origin_b", point_bits> origin_b;
constexpr Data<"floor_a", mantissa_bits> floor_a;
constexpr Data<"ceil_a", mantissa_bits> ceil_a;
constexpr Data<"floor_b", mantissa_bits> floor_b;
constexpr Data<"ceil_b", mantissa_bits> ceil_b;
constexpr Data<"exp_a", exponent_bits> exp_a;
constexpr Data<"exp_b", exponent_bits> exp_b;
constexpr SignedData<"parent_near", box_bits> parent_near;
constexpr SignedData<"parent_far", box_bits> parent_far;
constexpr SignedData<"xmin", coord_bits> xmin;
constexpr SignedData<"ymin", coord_bits> ymin;
constexpr SignedData<"zmin", coord_bits> zmin;
constexpr SignedData<"xmax", coord_bits> xmax;
constexpr SignedData<"ymax", coord_bits> ymax;
constexpr SignedData<"zmax", coord_bits> zmax;
constexpr Data<"own_xmin"> own_xmin;
constexpr Data<"own_ymin"> own_ymin;
constexpr Data<"own_zmin"> own_zmin;
constexpr Data<"own_xmax"> own_xmax;
constexpr Data<"own_ymax"> own_ymax;
constexpr Data<"own_zmax"> own_zmax;

struct Bounds : List<xmin, ymin, zmin, xmax, ymax, zmax> {};
struct OwnBounds : List<own_xmin, own_ymin, own_zmin, own_xmax, own_ymax, own_zmax> {};

constexpr Control<"there_1"> there_1;  // a record has come in the last cycle
constexpr Data<"ray_1", ray_bits> ray_1;
struct Record : Join<Bounds, OwnBounds, Children> {};

// By ray.
struct Origins : List<major_y, major_z, back_m, back_a, back_b, origin_m, origin_a, origin_b> {};
struct BoundsA : List<floor_a, ceil_a, exp_a> {};
struct BoundsB : List<floor_b, ceil_b, exp_b> {};
struct Parent : List<parent_near, parent_far> {};
constexpr BlockOf<"origins", &PairFeedBits::rays, Origins> origins;
constexpr BlockOf<"bounds_a", &PairFeedBits::rays, BoundsA> bounds_a;  // of reciprocals
constexpr BlockOf<"bounds_b", &PairFeedBits::rays, BoundsB> bounds_b;
constexpr BlockOf<"intervals", &PairFeedBits::rays, Parent>
    intervals;  // where the ray is in the record that it wants

struct PairFeed {
  static constexpr const char* name = "pair_feed";
  static constexpr const char* summary = "gives records and their rays to the unit for two boxes";
  using Bits = PairFeedBits;
  using BuiltIn =
      FormatList<Fixed<PairFeedBits{20, 1, 11, 0, 24, 5}>, Fixed<PairFeedBits{20, 1, 11, 0, 24, 7}>>;
  struct In : Join<Begun, Direction, Reciprocals, List<goes, walk_ray>, WalkInterval, BlockRead> {};
  struct Out : Join<Begins, Children, Origins, BoundsA, BoundsB, Parent, Bounds, OwnBounds> {};
  struct State : Join<List<there_1, ray_1>, Held<Record>> {};
  struct Memory : List<origins, bounds_a, bounds_b, intervals> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    out[begins] = now[there_1];
    out[test_ray] = now[ray_1];
    out.copy(memory[origins].word());
    out.copy(memory[bounds_a].word());
    out.copy(memory[bounds_b].word());
    out.copy(memory[intervals].word());
    out.from_held(now, Record());
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& /*now*/, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const PairFeedBits bits = f;
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
    memory[intervals].write(in[goes], in[walk_ray], in[enters_at], in[leaves_at]);

    const auto ray = reader_of(in);
    memory[origins].ask(ray);
    memory[bounds_a].ask(ray);
    memory[bounds_b].ask(ray);
    memory[intervals].ask(ray);
    next[there_1] = in[read_valid] & ~Bit(reads_triangle(in));
    next[ray_1] = ray;
    const auto n = xmin.width(f);
    next[held<xmin>] = coordinate<0>(in, n);
    next[held<ymin>] = coordinate<1>(in, n);
    next[held<zmin>] = coordinate<2>(in, n);
    next[held<xmax>] = coordinate<3>(in, n);
    next[held<ymax>] = coordinate<4>(in, n);
    next[held<zmax>] = coordinate<5>(in, n);
    next[held<own_xmin>] = piece<144, 1>(in);
    next[held<own_ymin>] = piece<145, 1>(in);
    next[held<own_zmin>] = piece<146, 1>(in);
    next[held<own_xmax>] = piece<147, 1>(in);
    next[held<own_ymax>] = piece<148, 1>(in);
    next[held<own_zmax>] = piece<149, 1>(in);
    const auto pointer = piece<160, 32>(in);
    next[held<block>] = resize(pointer, block.width(f));
    const Bit no_record = as("no_record", is_unread<D>(in, record_block, bits.coord));
    const auto too_large = either(
        block.width(f) < 32_w, pointer, [&](const auto& p) { return any<D>(slice(p, 31_w, block.width(f))); },
        [&](const auto&) { return D::lit(0, 1_w); });
    const auto counts_0 = piece<192, child_count_bits>(in), counts_1 = piece<200, child_count_bits>(in);
    const auto kept = count_0.width(f);
    const Bit lost =
        change_if(kept < Width<child_count_bits>(), Bit(no_record | too_large), [&](const auto& so_far) {
          const auto is_no_leaf = [&](const auto& count) { return exceeds<D>(count, kept) & any<D>(~count); };
          return Bit(so_far | is_no_leaf(counts_0) | is_no_leaf(counts_1));
        });
    next[held<flaw>] = cat(lost, no_record);
    next[held<count_0>] = resize(counts_0, kept);
    next[held<count_1>] = resize(counts_1, kept);
  }
};

}  // namespace pair_feed

using pair_feed::PairFeed;

}  // namespace hitpipe::hls
