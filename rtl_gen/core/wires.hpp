// How the machines and units of a core are joined (docs/core.md). The top module of a core and its software
// are made from these lists. Of the wires around the triangle test, and of those behind `replies`, a core has
// one list. Operands of a unit have a wire each from the machine that feeds it, with the operands' names;
// make_core() adds these.
#pragma once

#include <array>
#include <string_view>

namespace hitpipe::rtl {

/// From an output of a part to an input of another one. Both have one width.
struct Wire {
  std::string_view from, output;
  std::string_view to, input;
};

inline constexpr std::array core_wires{
    // A new ray begins.
    Wire{"door", "ray_ready", "pair_feed", "ray_ready"},
    Wire{"door", "begun_at", "pair_feed", "begun_at"},
    Wire{"door", "ray_ready", "replies", "ray_ready"},
    Wire{"door", "begun_at", "replies", "begun_at"},
    Wire{"door", "new_ray", "best_hits", "new_ray"},
    Wire{"door", "begun", "best_hits", "begun"},
    Wire{"door", "length", "best_hits", "length"},
    Wire{"door", "any", "best_hits", "any"},
    Wire{"best_hits", "takes", "door", "takes"},
    Wire{"walker", "takes", "best_hits", "walker_takes"},
    Wire{"best_hits", "begins", "walker", "begins"},
    Wire{"best_hits", "begin_ray", "walker", "begun"},
    Wire{"best_hits", "begin_cut", "walker", "length"},
    // A ray goes to a record or a leaf.
    Wire{"walker", "goes", "reader", "go"},
    Wire{"walker", "of", "reader", "goer"},
    Wire{"walker", "wanted", "reader", "block"},
    Wire{"walker", "triangles", "reader", "triangles"},
    Wire{"walker", "goes", "pair_feed", "go"},
    Wire{"walker", "of", "pair_feed", "goer"},
    Wire{"walker", "enters_at", "pair_feed", "enters_at"},
    Wire{"walker", "leaves_at", "pair_feed", "leaves_at"},
    Wire{"reader", "asks", "requests", "asks"},
    Wire{"reader", "wanted", "requests", "wanted"},
    Wire{"reader", "asker", "requests", "asker"},
    Wire{"reader", "triangle", "requests", "triangle"},
    Wire{"requests", "granted", "reader", "granted"},
    // A record has come and is tested.
    Wire{"pair_feed", "begins", "walker", "reads"},
    Wire{"pair_feed", "test_ray", "walker", "read_ray"},
    Wire{"pair_feed", "block", "walker", "block"},
    Wire{"pair_feed", "count_0", "walker", "count_0"},
    Wire{"pair_feed", "count_1", "walker", "count_1"},
    Wire{"pair_feed", "begins", "pair", "in_valid"},
    Wire{"pair_feed", "test_ray", "pair", "in_tag"},
    Wire{"pair", "out_valid", "walker", "tested"},
    Wire{"pair", "out_tag", "walker", "ray"},
    Wire{"pair", "hit_0", "walker", "hit_0"},
    Wire{"pair", "hit_1", "walker", "hit_1"},
    Wire{"pair", "near_0", "walker", "near_0"},
    Wire{"pair", "far_0", "walker", "far_0"},
    Wire{"pair", "near_1", "walker", "near_1"},
    Wire{"pair", "far_1", "walker", "far_1"},
    Wire{"pair", "second_first", "walker", "second_first"},
    // A hit was compared with the best one.
    Wire{"best_hits", "divided", "reader", "divides"},
    Wire{"best_hits", "divided_ray", "reader", "divided_ray"},
    Wire{"best_hits", "divided_stops", "reader", "stops"},
    // A leaf is done.
    Wire{"reader", "done", "best_hits", "leaf"},
    Wire{"reader", "of", "best_hits", "leaf_ray"},
    Wire{"reader", "stopped", "best_hits", "stops"},
    Wire{"reader", "lost", "best_hits", "lost"},
    Wire{"best_hits", "leaf_done", "walker", "leaf"},
    Wire{"best_hits", "leaf_done_ray", "walker", "leaf_ray"},
    Wire{"best_hits", "leaf_done_cut", "walker", "cut"},
    Wire{"best_hits", "leaf_done_stops", "walker", "stops"},
    Wire{"best_hits", "leaf_done_lost", "walker", "lost"},
    // A walk ends.
    Wire{"walker", "ended", "best_hits", "ended"},
    Wire{"walker", "of", "best_hits", "ender"},
    Wire{"walker", "failed", "best_hits", "failed"},
    Wire{"best_hits", "answers", "replies", "answer"},
    Wire{"best_hits", "answered", "replies", "answered"},
    Wire{"best_hits", "answer_t", "replies", "answer_t"},
    Wire{"best_hits", "answer_number", "replies", "answer_number"},
    Wire{"best_hits", "answer_failed", "replies", "answer_failed"},
};

/// An answer that has left frees its ray's number.
inline constexpr std::array plain_answer_wires{
    Wire{"replies", "freed", "door", "freed"},
    Wire{"replies", "freed_ray", "door", "freed_ray"},
};

/// With weights: the machine that keeps them stands behind `replies`.
inline constexpr std::array weight_wires{
    Wire{"triangle", "out_valid", "weights", "tested"},
    Wire{"triangle", "hit", "weights", "test_hit"},
    Wire{"triangle", "out_tag", "weights", "tester"},
    Wire{"triangle", "det_high", "weights", "det_high"},
    Wire{"triangle", "det_low", "weights", "det_low"},
    Wire{"triangle", "u_high", "weights", "u_high"},
    Wire{"triangle", "u_low", "weights", "u_low"},
    Wire{"triangle", "v_high", "weights", "v_high"},
    Wire{"triangle", "v_low", "weights", "v_low"},
    Wire{"divider", "asked", "weights", "asked"},
    Wire{"divider", "done", "weights", "done"},
    Wire{"divider", "closer", "weights", "closer"},
    Wire{"replies", "hit_valid", "weights", "answer"},
    Wire{"replies", "hit_tag", "weights", "answer_tag"},
    Wire{"replies", "hit_failed", "weights", "answer_failed"},
    Wire{"replies", "hit_number", "weights", "answer_number"},
    Wire{"replies", "hit_t", "weights", "answer_t"},
    Wire{"replies", "freed", "weights", "left"},
    Wire{"replies", "freed_ray", "weights", "left_ray"},
    Wire{"weights", "takes", "replies", "hit_ready"},
    Wire{"weights", "freed", "door", "freed"},
    Wire{"weights", "freed_ray", "door", "freed_ray"},
};

/// With the unit int_triangle.
inline constexpr std::array triangle_unit_wires{
    Wire{"door", "ray_ready", "triangle_feed", "ray_ready"},
    Wire{"door", "begun_at", "triangle_feed", "begun_at"},
    // A triangle has come and is tested.
    Wire{"triangle_feed", "reads", "best_hits", "reads"},
    Wire{"triangle_feed", "read_ray", "best_hits", "read_ray"},
    Wire{"triangle_feed", "number", "best_hits", "number"},
    Wire{"triangle_feed", "begins", "triangle", "in_valid"},
    Wire{"triangle_feed", "test_ray", "triangle", "in_tag"},
    Wire{"triangle", "in_ready", "triangle_feed", "unit_takes"},
    Wire{"triangle", "out_valid", "reader", "tested"},
    Wire{"triangle", "out_tag", "reader", "tester"},
    Wire{"triangle", "hit", "reader", "hit"},
    Wire{"triangle", "out_valid", "divider", "tested"},
    Wire{"triangle", "out_tag", "divider", "ray"},
    Wire{"triangle", "hit", "divider", "hit"},
    Wire{"triangle", "det_high", "divider", "det_high"},
    Wire{"triangle", "det_low", "divider", "det_low"},
    Wire{"triangle", "num_high", "divider", "num_high"},
    Wire{"triangle", "num_low", "divider", "num_low"},
    // A hit is compared with the best one.
    Wire{"divider", "asked", "best_hits", "asked"},
    Wire{"divider", "done", "best_hits", "done"},
    Wire{"divider", "t", "best_hits", "t"},
    Wire{"divider", "closer", "best_hits", "closer"},
    Wire{"best_hits", "asked_number", "divider", "number"},
    Wire{"best_hits", "best", "divider", "best"},
    Wire{"best_hits", "best_number", "divider", "best_number"},
};

/// With the machine serial_triangle in place of this unit, its feed and the divider.
inline constexpr std::array serial_triangle_wires{
    Wire{"door", "ray_ready", "serial_triangle", "ray_ready"},
    Wire{"door", "begun_at", "serial_triangle", "begun_at"},
    Wire{"serial_triangle", "reads", "best_hits", "reads"},
    Wire{"serial_triangle", "read_ray", "best_hits", "read_ray"},
    Wire{"serial_triangle", "number", "best_hits", "number"},
    Wire{"serial_triangle", "tested", "reader", "tested"},
    Wire{"serial_triangle", "asked", "reader", "tester"},
    Wire{"serial_triangle", "hit", "reader", "hit"},
    Wire{"serial_triangle", "asked", "best_hits", "asked"},
    Wire{"serial_triangle", "done", "best_hits", "done"},
    Wire{"serial_triangle", "t", "best_hits", "t"},
    Wire{"serial_triangle", "closer", "best_hits", "closer"},
    Wire{"best_hits", "asked_number", "serial_triangle", "asked_number"},
    Wire{"best_hits", "best", "serial_triangle", "best"},
    Wire{"best_hits", "best_number", "serial_triangle", "best_number"},
};

/// A pin of the core, and what it tells the reader of the Verilog. An input goes to every machine that has an
/// input of this name without a wire; an output comes from the machine.
struct CorePin {
  std::string_view name;
  std::string_view from;  ///< the machine; empty: an input
  std::string_view comment;
};

inline constexpr std::array core_pins{
    CorePin{"ray_valid", "", "a new ray, as the unit int_ray makes it"},
    CorePin{"ray_ready", "door", "it begins at a clock edge with both high"},
    CorePin{"ray_tag", "", "comes back with its answer"},
    CorePin{"ray_any", "", "1: any hit will do; 0: the nearest"},
    CorePin{"ray_error", "", "1: it is no ray; its answer has failed"},
    CorePin{"ray_major_y", "", "1: the major axis is y"},
    CorePin{"ray_major_z", "", "1: the major axis is z; x when both are 0"},
    CorePin{"ray_back_m", "", "1: the direction is negative on the major axis"},
    CorePin{"ray_back_a", "", "likewise on ray axis a"},
    CorePin{"ray_back_b", "", "likewise on ray axis b"},
    CorePin{"ray_origin_m", "", "on the grid of n+g bits, by ray axis"},
    CorePin{"ray_origin_a", "", ""},
    CorePin{"ray_origin_b", "", ""},
    CorePin{"ray_s_a", "", "slope, 0..2^S"},
    CorePin{"ray_s_b", "", ""},
    CorePin{"ray_floor_a", "", "lower bound of the slope's reciprocal"},
    CorePin{"ray_ceil_a", "", "upper bound"},
    CorePin{"ray_exp_a", "", "exponent of both"},
    CorePin{"ray_floor_b", "", ""},
    CorePin{"ray_ceil_b", "", ""},
    CorePin{"ray_exp_b", "", ""},
    CorePin{"ray_length", "", "largest T of the ray"},
    CorePin{"hit_valid", "replies", "an answer; answers have any order"},
    CorePin{"hit_ready", "", "it has left at a clock edge with both high"},
    CorePin{"hit_tag", "replies", ""},
    CorePin{"hit_failed", "replies",
            "1: no ray, at a bound of the walk, or outside the image; the rest means nothing"},
    CorePin{"hit_number", "replies", "of the triangle; all ones: no hit"},
    CorePin{"hit_t", "replies", "T of the hit; without one the ray's length"},
    CorePin{"request_valid", "requests", "a block of 32 bytes is wanted"},
    CorePin{"request_ready", "", "memory takes the request at a clock edge with both high"},
    CorePin{"request_address", "requests", "of bytes, a multiple of 32"},
    CorePin{"request_id", "requests", "a ray's number, and above it 1 for a triangle; one request a ray"},
    CorePin{"read_valid", "", "memory gives a block, in any order; it is taken at once"},
    CorePin{"read_id", "", "of the request"},
    CorePin{"read_word_0", "", "its first 8 bytes, the lowest address in the lowest bits"},
    CorePin{"read_word_1", "", ""},
    CorePin{"read_word_2", "", ""},
    CorePin{"read_word_3", "", ""},
    CorePin{"base", "",
            "address of the image, divided by 32; constant while rays are in flight, as all below"},
    CorePin{"last", "", "number of the image's last block"},
    CorePin{"most_steps", "", "records that a ray may test, 1 or more"},
    CorePin{"most_rays", "", "rays in flight; it only grows until the next reset"},
};

/// With weights, answers come from this machine, and these pins are there too.
inline constexpr std::string_view weights_part = "weights";
inline constexpr std::array weight_pins{
    CorePin{"hit_det_high", weights_part, "det, u and v of the hit; weight 1 is |u| / (2^g |det|)"},
    CorePin{"hit_det_low", weights_part, ""},
    CorePin{"hit_u_high", weights_part, ""},
    CorePin{"hit_u_low", weights_part, ""},
    CorePin{"hit_v_high", weights_part, "weight 2 is |v| / (2^g |det|)"},
    CorePin{"hit_v_low", weights_part, ""},
};

/// With floats at the door, the unit `ray`, an int_ray, has the pins of a ray. Its operands are pins too:
/// ray_ox, ray_oy, ...
struct RayPin {
  std::string_view name, pin, comment;
};
inline constexpr std::array ray_unit_pins{
    RayPin{"ray_valid", "in_valid", "a new ray, in floats"},
    RayPin{"ray_ready", "in_ready", "it is taken at a clock edge with both high"},
    RayPin{"ray_tag", "in_tag", "comes back with its answer"},
    RayPin{"ray_any", "in_any", "1: any hit will do; 0: the nearest"},
};
/// And an output of this unit goes to every machine that has the input "ray_OUTPUT", but for these.
struct RayResult {
  std::string_view output, input;
};
inline constexpr std::array ray_unit_results{
    RayResult{"out_valid", "ray_valid"},
    RayResult{"out_tag", "ray_tag"},
    RayResult{"out_any", "ray_any"},
    RayResult{"t_end", "ray_length"},
};

}  // namespace hitpipe::rtl
