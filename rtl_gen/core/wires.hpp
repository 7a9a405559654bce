// How the machines and units of a core are joined (docs/core.md). The top module of a core and its software
// are made from these lists. Machines are joined by channels (hls/machines/channels.hpp). Of the links around
// the triangle test, and of those behind `replies`, a core has one list.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "hls/machines/cache.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/rings.hpp"
#include "hls/machines/ties.hpp"
#include "hls/machines/weights.hpp"

namespace hitpipe::rtl {

/// The names of a list's fields.
template <class Fields>
inline constexpr auto field_names = []<auto... F>(hls::List<F...>) {
  return std::array<std::string_view, sizeof...(F)>{F.name()...};
}
(typename Fields::Items());

/// A channel from one machine to another. Its fields are joined in their order, but for those that one of the
/// machines does not have.
struct Link {
  using Names = std::span<const std::string_view>;

  std::string_view from, to;
  Names given, taken;            ///< outputs of the one, inputs of the other
  Names given_back, taken_back;  ///< outputs of the other, inputs of the one
};
/// The taker may have the fields of another channel, with other names.
template <class Given, class Taken = Given>
constexpr Link link(std::string_view from, std::string_view to) {
  Link made{from, to, field_names<Given>, field_names<Taken>, {}, {}};
  if constexpr (requires { typename Given::Back; }) {
    made.given_back = field_names<typename Taken::Back>;
    made.taken_back = field_names<typename Given::Back>;
  }
  return made;
}

namespace links {

using namespace hls::channels;

inline constexpr std::array core{
    // A new ray begins.
    link<NewNumber>("door", "pair_feed"),
    link<NewNumber>("door", "replies"),
    link<NewRay>("door", "best_hits"),
    link<Starts>("best_hits", "walker"),
    // A ray goes to a record or a leaf.
    link<Goes>("walker", "reader"),
    link<hls::Join<Goes, WalkInterval>>("walker", "pair_feed"),
    // A record has come and is tested.
    link<hls::Join<Begins, Children>>("pair_feed", "walker"),
    // A hit was compared with the best one.
    link<Divided>("best_hits", "reader"),
    // A leaf is done.
    link<LeafDone>("reader", "best_hits"),
    link<Returns>("best_hits", "walker"),
    // A walk ends.
    link<Ended>("walker", "best_hits"),
    link<Answers>("best_hits", "replies"),
};

/// Without a cache.
inline constexpr std::array requests{link<Asks>("reader", "requests")};
/// With one, blocks come from it.
inline constexpr std::array cache{
    link<Asks>("reader", "cache"),
    link<BlockRead>("cache", "pair_feed"),
};
inline constexpr std::array cache_to_unit{link<BlockRead>("cache", "triangle_feed")};
inline constexpr std::array cache_to_serial{link<BlockRead>("cache", "serial_triangle")};

/// An answer that has left frees its ray's number.
inline constexpr std::array plain_answers{link<Freed>("replies", "door")};

/// With rings, answers go to memory.
inline constexpr std::array answers_to_rings{link<Hits>("replies", "rings")};

/// With weights: the machine that keeps them stands behind `replies`.
inline constexpr std::array answers_with_weights{
    link<Divides>("divider", "weights"),
    link<Hits, HitsToWeights>("replies", "weights"),
    link<Freed, FreedToWeights>("replies", "weights"),
    link<Freed>("weights", "door"),
};

/// With the unit int_triangle.
inline constexpr std::array triangle_unit{
    link<NewNumber>("door", "triangle_feed"),
    link<TriangleRead>("triangle_feed", "best_hits"),
    link<TriangleFlaw>("triangle_feed", "reader"),
    link<Divides>("divider", "best_hits"),
};

/// And with the questions count and next.
inline constexpr std::array questions{
    link<Compares>("divider", "best_hits"),
    link<Settled, hls::List<tested, hit, tester, again>>("ties", "reader"),
    link<Settled, Tested>("ties", "divider"),
    link<hls::ties::SettledNumbers, hls::ties::Numbers>("ties", "divider"),
    link<hls::ties::Next, Retests>("ties", "triangle_feed"),
};

/// With the machine serial_triangle in place of this unit, its feed and the divider.
inline constexpr std::array serial_triangle{
    link<NewNumber>("door", "serial_triangle"),
    link<TriangleRead>("serial_triangle", "best_hits"),
    link<TriangleFlaw>("serial_triangle", "reader"),
    link<hls::List<tested, hit, asked>, Tested>("serial_triangle", "reader"),
    link<Divides>("serial_triangle", "best_hits"),
};

}  // namespace links

/// A pin of the core, and what it tells the reader of the Verilog. An input goes to every machine that has an
/// input of this name without a wire; an output comes from the machine.
struct CorePin {
  std::string_view name;
  std::string_view from;  ///< the machine; empty: an input
  std::string_view comment;
  std::string_view of{};  ///< the output of the machine, if it has another name
};
constexpr CorePin input(auto field, std::string_view comment) {
  return {field.name(), "", comment};
}
constexpr CorePin output(auto field, std::string_view from, std::string_view comment) {
  return {field.name(), from, comment};
}
constexpr CorePin output_as(auto field, std::string_view from, auto of, std::string_view comment) {
  return {field.name(), from, comment, of.name()};
}

namespace pins {

using namespace hls::channels;

inline constexpr std::array rays{
    input(ray_valid, "a new ray, as the unit int_ray makes it"),
    output(ray_ready, "door", "it begins at a clock edge with both high"),
    input(ray_tag, "comes back with its answer"),
    input(ray_any, "1: any hit will do; 0: the nearest"),
    input(ray_once, "1: the next crossing, or with ray_any their count"),
    input(ray_from_t, "the next crossing has this T and number or later ones"),
    input(ray_from_number, ""),
    input(ray_error, "1: it is no ray; its answer has failed"),
    input(ray_major_y, "1: the major axis is y"),
    input(ray_major_z, "1: the major axis is z; x when both are 0"),
    input(ray_back_m, "1: the direction is negative on the major axis"),
    input(ray_back_a, "likewise on ray axis a"),
    input(ray_back_b, "likewise on ray axis b"),
    input(ray_origin_m, "on the grid of n+g bits, by ray axis"),
    input(ray_origin_a, ""),
    input(ray_origin_b, ""),
    input(ray_s_a, "slope, 0..2^S"),
    input(ray_s_b, ""),
    input(ray_floor_a, "lower bound of the slope's reciprocal"),
    input(ray_ceil_a, "upper bound"),
    input(ray_exp_a, "exponent of both"),
    input(ray_floor_b, ""),
    input(ray_ceil_b, ""),
    input(ray_exp_b, ""),
    input(ray_length, "largest T of the ray"),
    output(Hits::valid, "replies", "an answer; answers have any order"),
    input(Hits::ready, "it has left at a clock edge with both high"),
    output(Hits::tag, "replies", ""),
    output(Hits::failed, "replies",
           "0, or why it has failed: 1 no ray, 2 steps, 3 levels, 4 outside, 5 block not read"),
    output(Hits::number, "replies", "of the triangle; all ones: no hit"),
    output(Hits::t, "replies", "T of the hit; without one the ray's length"),
};
/// With rings in memory in place of these.
inline constexpr std::string_view rings_part = "rings";
inline constexpr std::array rings{
    input(rays_at, "address of the ring of rays, divided by 128; constant while rays are in flight"),
    input(answers_at, "of the ring of answers"),
    input(ring_last, "places of each ring, less 1: 2^k - 1, 3 or more"),
    input(rays_offered, "rays that are in memory, of all; counts go round at 2^16"),
    input(lets_rings, "0: no more is read or written; what has begun ends"),
    output(hls::rings::fetch_valid, rings_part, "rays are wanted"),
    input(hls::rings::fetch_ready, "memory takes the request at a clock edge with both high"),
    output(hls::rings::fetch_address, rings_part, "of bytes"),
    output(hls::rings::fetch_four, rings_part, "1: four rays of 32 bytes; 0: one"),
    input(hls::rings::fetched_valid, "memory gives a beat of them, in order; it is taken at once"),
    input(hls::rings::fetched_error, "1: it could not be read; its ray fails"),
    input(hls::rings::fetched_0, "its first 8 bytes, the lowest address in the lowest bits"),
    input(hls::rings::fetched_1, ""),
    output(hls::rings::store_valid, rings_part, "answers are to be written"),
    input(hls::rings::store_ready, "memory takes the address at a clock edge with both high"),
    output(hls::rings::store_address, rings_part, "of bytes"),
    output(hls::rings::store_four, rings_part, "1: four answers of 16 bytes; 0: one"),
    output(hls::rings::put_valid, rings_part, "a beat of them"),
    input(hls::rings::put_ready, "memory takes it at a clock edge with both high"),
    output(hls::rings::put_last, rings_part, "it is the last"),
    output(hls::rings::put_0, rings_part, "its first 8 bytes"),
    output(hls::rings::put_1, rings_part, ""),
    input(hls::rings::stored_valid, "they are in memory"),
    input(hls::rings::stored_error, "1: they could not be written"),
    output(ray_begins, rings_part, "a ray has begun in the cycle before; what follows is for registers"),
    output(Hits::valid, "replies", "an answer"),
    output(Hits::ready, rings_part, "it leaves at a clock edge with both high"),
    output(Hits::failed, "replies", "0, or why it has failed"),
    output(Hits::number, "replies", "of the triangle; all ones: no hit"),
    output(ring_answers, rings_part, "answers that are in memory, of all"),
    output(ring_busy, rings_part, "rays have not begun, or answers are not in memory"),
    output(ring_quiet, rings_part, "nothing is being read or written"),
    output(ring_error, rings_part, "something could not be read or written"),
};
/// To memory.
inline constexpr std::array blocks{
    output(request_valid, "requests", "a block of 32 bytes is wanted"),
    input(request_ready, "memory takes the request at a clock edge with both high"),
    output(request_address, "requests", "of bytes, a multiple of 32"),
    output(request_id, "requests", "a ray's number, and above it 1 for a triangle; one request a ray"),
    input(read_valid, "memory gives a block, in any order; it is taken at once"),
    input(read_id, "of the request"),
    input(read_word_0, "its first 8 bytes, the lowest address in the lowest bits"),
    input(read_word_1, ""),
    input(read_word_2, ""),
    input(read_word_3, ""),
    input(read_error, "1: it could not be read; its ray fails"),
};
/// The same with a cache. The bus may not have all of these.
inline constexpr std::array lines{
    output(request_valid, "cache", "a line is wanted"),
    input(request_ready, "memory takes the request at a clock edge with both high"),
    output(request_address, "cache", "of bytes, a multiple of a line's"),
    output(request_id, "cache", "no line on its way has the same"),
    input(beat_valid, "memory gives a beat of a line, the first bytes first"),
    output(beat_ready, "cache", "it is taken at a clock edge with both high"),
    input(hls::cache::beat_id, "of the request; beats of several may mingle"),
    input(beat_error, "1: it could not be read; rays that wait for it fail"),
    input(beat_0, "its first 8 bytes, the lowest address in the lowest bits"),
    input(beat_1, ""),
    input(beat_2, ""),
    input(beat_3, ""),
    input(beat_4, ""),
    input(beat_5, ""),
    input(beat_6, ""),
    input(beat_7, ""),
    input(most_lines, "lines that may be on their way, 1 or more"),
    input(empties_cache, "1: the cache forgets what it has; no ray is in flight"),
    input(lets_asks, "0: rays ask for no block; those that were asked for still come"),
    output(asks, "reader", "a ray asks for a block; what follows is for counters"),
    output(granted, "cache", "the cache takes the question at a clock edge with both high"),
    output_as(asks_triangle, "reader", triangle, "it is a triangle; else a record"),
    output(read_valid, "cache", "a block is given to its ray"),
    output(read_error, "cache", "1: it could not be read"),
    output(cache_hit, "cache", "a block was there"),
    output(cache_join, "cache", "it was on its way; else its line is asked for"),
};
inline constexpr std::array settings{
    input(base, "address of the image, divided by 64; constant while rays are in flight, as all below"),
    input(last, "number of the image's last block"),
    input(most_steps, "records that a ray may test, 1 or more"),
    input(most_rays, "rays in flight; it only grows until the next reset"),
};

/// Only with questions.
inline constexpr std::array<std::string_view, 3> question_names{ray_once.name(), ray_from_t.name(),
                                                                ray_from_number.name()};

/// With weights, answers come from this machine, and these pins are there too.
inline constexpr std::string_view weights_part = "weights";
inline constexpr std::array weights{
    output(hls::weights::HitDet::high, weights_part,
           "det, u and v of the hit; weight 1 is |u| / (2^g |det|)"),
    output(hls::weights::HitDet::low, weights_part, ""),
    output(hls::weights::HitU::high, weights_part, ""),
    output(hls::weights::HitU::low, weights_part, ""),
    output(hls::weights::HitV::high, weights_part, "weight 2 is |v| / (2^g |det|)"),
    output(hls::weights::HitV::low, weights_part, ""),
};

}  // namespace pins

/// With floats at the door, the unit `ray`, an int_ray, has the pins of a ray. Its operands are pins too:
/// ray_ox, ray_oy, ...
struct RayPin {
  std::string_view name, pin, comment;
};
inline constexpr std::array ray_unit_pins{
    RayPin{hls::channels::ray_valid.name(), "in_valid", "a new ray, in floats"},
    RayPin{hls::channels::ray_ready.name(), "in_ready", "it is taken at a clock edge with both high"},
    RayPin{hls::channels::ray_tag.name(), "in_tag", "comes back with its answer"},
    RayPin{hls::channels::ray_any.name(), "in_any", "1: any hit will do; 0: the nearest"},
};
/// With questions it passes on what a ray asks, behind the tag and in_any.
inline constexpr std::array ray_question_pins{
    RayPin{hls::channels::ray_once.name(), "in_once", "1: the next crossing, or with ray_any their count"},
    RayPin{hls::channels::ray_from_t.name(), "in_from_t",
           "the next crossing has this T and number or later ones"},
    RayPin{hls::channels::ray_from_number.name(), "in_from_number", ""},
};
/// What the triangle unit says again of each test, behind the ray's number.
struct TestPin {
  std::string_view given, in, out, taken;
  int width;
};
inline constexpr std::array test_pins{
    TestPin{hls::channels::test_is.name(), "in_is", "out_is", hls::ties::tested_is.name(),
            hls::channels::test_bits},
    TestPin{hls::channels::test_once.name(), "in_once", "out_once", hls::ties::tested_once.name(), 1},
    TestPin{hls::channels::test_down.name(), "in_down", "out_down", hls::ties::tested_down.name(), 1},
};
/// And an output of this unit goes to every machine that has the input "ray_OUTPUT", but for these.
struct RayResult {
  std::string_view output, input;
};
inline constexpr std::array ray_unit_results{
    RayResult{"out_valid", hls::channels::ray_valid.name()},
    RayResult{"out_tag", hls::channels::ray_tag.name()},
    RayResult{"out_any", hls::channels::ray_any.name()},
    RayResult{"out_once", hls::channels::ray_once.name()},
    RayResult{"out_from_t", hls::channels::ray_from_t.name()},
    RayResult{"out_from_number", hls::channels::ray_from_number.name()},
    RayResult{"t_end", hls::channels::ray_length.name()},
};

}  // namespace hitpipe::rtl
