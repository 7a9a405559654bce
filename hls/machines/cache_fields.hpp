// What the cache (cache.hpp) is made of: its format, registers and memories, and bits for each of its ways.
#pragma once

#include <utility>

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls {

/// The format "aAhHiIsSwWlLdD", for example a24h32i5s5w8l2d256, and "m1" behind it with identifiers.
struct CacheBits {
  int address = 24;  ///< A: bits of a block's number
  int bytes = 32;    ///< H: bits of an address, of bytes, at least A + 5
  int ray = 5;       ///< I: bits of a ray's number
  int set = 5;       ///< S: bits of a set's number
  int ways = 8;      ///< W: lines of a set: 2, 4, 8
  int blocks = 2;    ///< L: blocks of a line
  int data = 256;    ///< D: bits of a beat: 64, 128, 256, 512
  int ids = 0;       ///< M: 1: requests have identifiers, and beats come in any order; D is 256

  static constexpr FormatField fields[] = {
      {"a", "A", 4, 32}, {"h", "H", 9, 64}, {"i", "I", 1, 8},    {"s", "S", 1, 9},
      {"w", "W", 2, 8},  {"l", "L", 1, 2},  {"d", "D", 64, 512}, {"m", "M", 0, 1, nullptr, true}};
  static constexpr const char* condition =
      "H at least A+5, W and D powers of two, S and the bits of L less than A, and D 256 with M";

  constexpr bool valid() const {
    return bytes >= address + 5 && (ways & (ways - 1)) == 0 && (data & (data - 1)) == 0 &&
           set + block_bits() < address && (ids == 0 || data == 256);
  }
  constexpr int rays() const { return power_of_two(ray); }
  constexpr int sets() const { return power_of_two(set); }
  constexpr int way() const { return count_bits(ways); }
  /// Of a block in its line.
  constexpr int block_bits() const { return blocks - 1; }
  constexpr int tag() const { return address - block_bits() - set; }
  /// Of a line's place in the cache.
  constexpr int place() const { return set + way(); }
  constexpr int words() const { return power_of_two(place() + block_bits()); }
  /// Beats of a line. One of 512 bits is written half by half.
  constexpr int beats() const { return blocks * max(1, 256 / data); }
  constexpr int count() const { return count_bits(beats()); }
  constexpr bool counts() const { return beats() > 1; }
  /// With one identifier beats come in the order of the requests.
  constexpr bool in_order() const { return ids == 0; }
  constexpr bool counts_in_order() const { return counts() && in_order(); }
  constexpr bool counts_by_ray() const { return counts() && !in_order(); }
  /// Of the number that empties the cache.
  constexpr int empty() const { return max(set, ids * ray); }
  friend constexpr bool operator==(const CacheBits&, const CacheBits&) = default;
};

namespace cache {

using namespace channels;

constexpr int most_ways = 8;

/// A request on its way.
template <Name Prefix>
struct RequestOf {
  static constexpr Control<Prefix + Name("there")> there{};
  static constexpr Data<Prefix + Name("block"), address_bits> block{};
  static constexpr Data<Prefix + Name("ray"), ray_bits> ray{};
  static constexpr Data<Prefix + Name("triangle")> triangle{};
  using Items = List<there, block, ray, triangle>;
};
using Door = RequestOf<"door_">;    // it waits to be looked up
using Looked = RequestOf<"look_">;  // it is looked up

constexpr Control<"opens"> opens;  // the door takes requests
// A line is asked for.
constexpr Control<"asks_line"> asks_line;
constexpr Data<"line_block", block_place_bits> line_block;
constexpr Data<"line_id", ray_count_bits> line_id;
// Lines that have been asked for, until their last beat.
constexpr Control<"lines", ray_count_bits> lines;
constexpr ControlIf<"oldest", ray_bits, &CacheBits::in_order> oldest;  // the first of them
constexpr ControlIf<"beat_count", &CacheBits::count, &CacheBits::counts_in_order> beat_count;  // of that one
constexpr ControlIf<"had_error", 1, &CacheBits::counts_in_order> had_error;
// A line has come.
constexpr Control<"filled"> filled;
constexpr Data<"fill_place", &CacheBits::place> fill_place;
constexpr Data<"fill_error"> fill_error;
// A list of rays gets its blocks.
constexpr Control<"gives_list"> gives_list;
constexpr Data<"list_place", &CacheBits::place> list_place;
constexpr Data<"list_error"> list_error;
constexpr Data<"list_ray", ray_bits> list_ray;
// A block is given.
constexpr Control<"gives"> gives;
constexpr Data<"given_id", ray_count_bits> given_id;
constexpr Data<"given_error"> given_error;
// The cache is to be emptied, and is being emptied set by set.
constexpr Control<"will_empty"> will_empty;
constexpr Control<"empties", 1, 1> empties;
constexpr Control<"empty_set", &CacheBits::empty> empty_set;
// Ages of a set change one cycle after it was looked up.
constexpr Control<"ages_change"> ages_change;
constexpr Data<"aged_set", &CacheBits::set> aged_set;
constexpr Data<"was_known"> was_known;
constexpr Data<"was_high", &CacheBits::ways> was_high;
constexpr Data<"was_low", &CacheBits::ways> was_low;
constexpr Data<"wanted", &CacheBits::ways> wanted;  // the way that was known
constexpr Data<"left", &CacheBits::ways> left;      // the way whose line has left, if none was known
constexpr Control<"was_hit"> was_hit;
constexpr Control<"was_join"> was_join;

constexpr Data<"valid"> valid;
constexpr Data<"tag", &CacheBits::tag> tag;
struct Line : List<valid, tag> {};

constexpr Data<"next_ray", ray_bits> next_ray;
constexpr Data<"is_last"> is_last;
constexpr Data<"half"> half;  // the block in the line
constexpr Data<"of_triangle"> of_triangle;
struct Link : List<next_ray, is_last, half, of_triangle> {};
inline constexpr auto came_bits = [](const auto& format) { return max(1, format.count()); };
constexpr Data<"came", came_bits> came;
constexpr Data<"error_before"> error_before;
struct Came : List<came, error_before> {};

template <int Way>
inline constexpr Name<2> digit = [] {
  const char text[2] = {static_cast<char>('0' + Way), 0};
  return Name<2>(text);
}();
template <int Way>
inline constexpr auto has_way = [](const auto& format) { return Way < format.ways; };
// Of each way: a set's line, whether it is on its way, and the newest of the rays that wait for it.
template <int Way>
constexpr LookupOfIf<Name("line_") + digit<Way>, &CacheBits::sets, Line, has_way<Way>> way_line;
template <int Way>
constexpr LookupIf<Name("coming_") + digit<Way>, &CacheBits::sets, 1, has_way<Way>> way_coming;
template <int Way>
constexpr LookupIf<Name("newest_") + digit<Way>, &CacheBits::sets, ray_bits, has_way<Way>> way_newest;
constexpr Data<"age_high", &CacheBits::ways> age_high;
constexpr Data<"age_low", &CacheBits::ways> age_low;
struct Ages : List<age_high, age_low> {};
constexpr LookupOf<"ages", &CacheBits::sets, Ages> ages;               // of the ways of a set
constexpr LookupOf<"links", &CacheBits::rays, Link> links;             // by ray
constexpr Lookup<"asked", &CacheBits::rays, &CacheBits::place> asked;  // a queue, or by ray
constexpr LookupOfIf<"beats", &CacheBits::rays, Came, &CacheBits::counts_by_ray> beats;
constexpr BlockApart<"words_0", &CacheBits::words, 64> words_0;  // of the blocks
constexpr BlockApart<"words_1", &CacheBits::words, 64> words_1;
constexpr BlockApart<"words_2", &CacheBits::words, 64> words_2;
constexpr BlockApart<"words_3", &CacheBits::words, 64> words_3;

constexpr DataIf<"beat_id", ray_count_bits, &CacheBits::ids> beat_id;  // of the beat's request

/// Calls visit(Width<WAY>()) for each way.
template <class Visit>
constexpr void for_each_way(const CacheBits& bits, const Visit& visit) {
  [&]<int... Way>(std::integer_sequence<int, Way...>) {
    ((Way < bits.ways ? void(visit(Width<Way>())) : void()), ...);
  }
  (std::make_integer_sequence<int, most_ways>());
}
/// In three levels of gates.
template <class X>
constexpr X or_of(const X (&x)[most_ways]) {
  return X(X(X(x[0] | x[1]) | X(x[2] | x[3])) | X(X(x[4] | x[5]) | X(x[6] | x[7])));
}
/// A bit for each way.
template <class D>
struct Ways {
  using Bit = typename D::bit;
  Bit is[most_ways];

  template <class Make>
  constexpr Ways(const CacheBits& bits, const Make& make) {
    for (Bit& bit : is) bit = D::lit(0, 1_w);
    for_each_way(bits, [&](auto way) { is[way] = make(way); });
  }
  constexpr Bit any() const {
    return any_of([](int) { return true; });
  }
  /// The number of the way whose bit is 1, if there is one.
  constexpr auto number(const auto& width) const {
    const auto digit = [&](int k) { return any_of([&](int way) { return (way >> k & 1) != 0; }); };
    return slice(cat(digit(2), digit(1), digit(0)), width - 1_w, 0_w);
  }
  constexpr auto word(const auto& width) const {
    return slice(cat(is[7], is[6], is[5], is[4], is[3], is[2], is[1], is[0]), width - 1_w, 0_w);
  }

 private:
  template <class Takes>
  constexpr Bit any_of(const Takes& takes) const {
    Bit taken[most_ways];
    for (int way = 0; way < most_ways; ++way) taken[way] = takes(way) ? is[way] : Bit(D::lit(0, 1_w));
    return or_of(taken);
  }
};

}  // namespace cache

}  // namespace hitpipe::hls
