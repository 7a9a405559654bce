// How the machines and units of a core are joined (docs/core.md). The top module of a core and its software
// are made from these lists. Machines are joined by channels (hls/machines/channels.hpp). Of the links around
// the triangle test, and of those behind `replies`, a core has one list.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "hls/machines/channels.hpp"
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
    link<Asks>("reader", "requests"),
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

/// An answer that has left frees its ray's number.
inline constexpr std::array plain_answers{link<Freed>("replies", "door")};

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
};
constexpr CorePin input(auto field, std::string_view comment) {
  return {field.name(), "", comment};
}
constexpr CorePin output(auto field, std::string_view from, std::string_view comment) {
  return {field.name(), from, comment};
}

namespace pins {

using namespace hls::channels;

inline constexpr std::array core{
    input(ray_valid, "a new ray, as the unit int_ray makes it"),
    output(ray_ready, "door", "it begins at a clock edge with both high"),
    input(ray_tag, "comes back with its answer"),
    input(ray_any, "1: any hit will do; 0: the nearest"),
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
    input(base, "address of the image, divided by 64; constant while rays are in flight, as all below"),
    input(last, "number of the image's last block"),
    input(most_steps, "records that a ray may test, 1 or more"),
    input(most_rays, "rays in flight; it only grows until the next reset"),
};

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
/// And an output of this unit goes to every machine that has the input "ray_OUTPUT", but for these.
struct RayResult {
  std::string_view output, input;
};
inline constexpr std::array ray_unit_results{
    RayResult{"out_valid", hls::channels::ray_valid.name()},
    RayResult{"out_tag", hls::channels::ray_tag.name()},
    RayResult{"out_any", hls::channels::ray_any.name()},
    RayResult{"t_end", hls::channels::ray_length.name()},
};

}  // namespace hitpipe::rtl
