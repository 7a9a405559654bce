// The generators in the table of categories, by the file that contains them.
#pragma once

#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref::adversary {

// aimed.cpp
Case random_case(Random& random);
Case corner(Random& random);
Case edge(Random& random);
Case face(Random& random);
Case flat_box(Random& random);
Case line_box(Random& random);
Case point_box(Random& random);

// direction.cpp
Case axis_parallel(Random& random);
Case nearly_axis_parallel(Random& random);
Case in_face_plane(Random& random);
Case zero_components(Random& random);
Case stiff(Random& random);
Case exponent_extremes(Random& random);

// origin.cpp
Case touching_origin(Random& random);
Case origin_inside(Random& random);
Case origin_on_face(Random& random);
Case origin_on_edge(Random& random);
Case origin_on_corner(Random& random);
Case behind(Random& random);

// length.cpp
Case length_at_entry(Random& random);
Case length_at_exit(Random& random);
Case length_zero(Random& random);
Case length_subnormal(Random& random);
Case length_huge(Random& random);

// grid.cpp
Case grid_ends(Random& random);
Case one_grid_unit(Random& random);
Case subnormal_coordinates(Random& random);

}  // namespace hitpipe::ref::adversary
