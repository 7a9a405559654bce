#include "sw_ref/judge/adversary/categories.hpp"

#include "sw_ref/judge/adversary/generators.hpp"

namespace hitpipe::ref::adversary {

std::span<const Category> categories() {
  static constexpr Category table[] = {
      {"random", "nothing special: the rest is judged beside it", random_case},
      {"corner", "aimed at a corner, within 4 ulps", corner},
      {"edge", "aimed at a point of an edge, within 4 ulps", edge},
      {"face", "aimed at a point of a face, within 4 ulps", face},
      {"flat_box", "box without extent on one axis, aimed at", flat_box},
      {"line_box", "box without extent on two axes, aimed at", line_box},
      {"point_box", "box of one point, aimed at", point_box},
      {"axis_parallel", "one component is not zero, slabs met, touched or missed by an ulp", axis_parallel},
      {"nearly_axis_parallel", "small components on both sides of half a unit of direction",
       nearly_axis_parallel},
      {"in_face_plane", "ray in the plane of a face, or an ulp beside it", in_face_plane},
      {"zero_components", "zeros of both signs in origin, direction and box", zero_components},
      {"stiff", "component ratios 2^0 to 2^-149, every order of the axes", stiff},
      {"exponent_extremes", "direction components and length of any exponent", exponent_extremes},
      {"touching_origin", "box with a face, an edge or a corner at coordinate +0 or -0", touching_origin},
      {"origin_inside", "ray starts inside the box", origin_inside},
      {"origin_on_face", "ray starts on a face, within an ulp", origin_on_face},
      {"origin_on_edge", "ray starts on an edge, within an ulp", origin_on_edge},
      {"origin_on_corner", "ray starts on a corner, within an ulp", origin_on_corner},
      {"behind", "aimed away from the box, which may touch the ray's start", behind},
      {"length_at_entry", "ray ends where it enters the box, or one ulp to either side", length_at_entry},
      {"length_at_exit", "ray ends where it leaves the box, or one ulp to either side", length_at_exit},
      {"length_zero", "ray is its origin alone", length_zero},
      {"length_subnormal", "length below 2^-126, direction from small to huge", length_subnormal},
      {"length_huge", "length up to the largest binary32, direction from tiny to one", length_huge},
      {"grid_ends", "coordinates at +-1, next to it and at its padded margin", grid_ends},
      {"one_grid_unit", "ties and steps of an n-bit grid; across the cube, every rounding at its worst",
       one_grid_unit},
      {"subnormal_coordinates", "subnormal coordinates of origin or box, or subnormal directions",
       subnormal_coordinates},
  };
  return table;
}

}  // namespace hitpipe::ref::adversary
