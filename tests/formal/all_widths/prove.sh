#!/usr/bin/env bash
# Proves with Coq, in all widths: int_major and int_major_pair never miss, in both worlds; a ray crosses a
# closed mesh an even number of times; a walk with a short stack loses nothing: prove.sh.
# docs/formal.md explains.
# It prints what each theorem assumes, and compares the definitions with the C++ on random rays and trees.
# It fails if a proof fails, if a theorem assumes an axiom, or if a case differs.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
cases=500

files=(Numbers IntMajor SetUp FloatQuotient FloatGrid NeverMisses IntegerWorld Words Shifter Datapath Ranges Pair
  IntegerTriangle Triangle TriangleHit Divider Crossing CrossingMesh SharedEdge CrossingRay FaceAhead
  Tetrahedron CrossingOrigin Walk Needed Compare CompareWalk)
theorems=(
  NeverMisses.never_misses
  Ranges.datapath_never_misses
  Pair.pair_never_misses
  Pair.interval_keeps_point
  Pair.interval_keeps_distance
  Pair.path_is_reached
  Datapath.words_equal_integers
  Ranges.set_up_fits
  IntegerWorld.integer_hit_is_accepted
  IntegerWorld.slope_quotient_has_bounds
  Ranges.integer_set_up_fits
  Ranges.datapath_accepts_integer_hit
  IntegerTriangle.triangle_in_box
  IntegerTriangle.triangle_hit_is_accepted
  IntegerTriangle.pair_keeps_integer_hit
  IntegerTriangle.pair_accepts_integer_hit
  IntegerTriangle.pair_accepts_triangle_hit
  Triangle.edge_determinant_0
  Triangle.edge_determinant_1
  Triangle.edge_determinant_2
  Triangle.edge_determinants_sum
  Triangle.to_corner0_is
  Triangle.point_in_plane
  Triangle.determinant_below
  Triangle.numbers_fit
  TriangleHit.numbers_of_ray_fit
  TriangleHit.criterion_is_hit
  TriangleHit.hit_has_distance
  TriangleHit.criterion_in_ray_axes
  TriangleHit.criterion_hit_is_accepted
  Divider.step_divides
  Divider.divide_is_floor
  Divider.distance_is_floor
  Divider.remainder_fits
  Crossing.triangle_edges
  Crossing.crosses_from_next_corner
  Crossing.crosses_from_other_side
  Crossing.crossed_is_hit
  Crossing.hit_inside_is_crossed
  CrossingMesh.closed_mesh_is_crossed_evenly
  CrossingMesh.oriented_mesh_is_crossed_evenly
  SharedEdge.passes_within_is
  SharedEdge.shared_edge_is_crossed_once
  SharedEdge.folded_edge_is_crossed_evenly
  SharedEdge.never_both_sides
  SharedEdge.corner_may_be_left
  CrossingRay.edges_seen
  CrossingRay.unit_rule_is_crosses
  CrossingRay.world_side
  CrossingRay.crossed_ahead_is_hit
  CrossingRay.hit_inside_is_crossed
  CrossingRay.ray_crosses_one_at_edge
  CrossingRay.ray_crosses_evenly_at_fold
  CrossingRay.ray_crosses_closed_mesh_evenly
  Tetrahedron.faces_ahead_are_odd_inside
  CrossingOrigin.count_ahead_is_of_origin
  CrossingOrigin.ray_crosses_ahead_is
  CrossingOrigin.origin_is_inside_or_outside
  Walk.walk_forgets_nothing
  Walk.walk_finds_the_least
  Walk.any_hit_is_found
  Walk.each_leaf_once
  Walk.each_hit_is_met
  Walk.count_meets_each_hit
  Words.sum_with_carry_is
  Shifter.saturating_shift_is_clamp
  SetUp.quotient_has_bounds
  SetUp.mantissas_adjacent
  SetUp.major_axis_is_major
  FloatQuotient.float_quotient_is_quotient
  FloatGrid.fine_nearest_is
  FloatGrid.fine_lower_is
  FloatGrid.lower_from_floor
  FloatGrid.origin_word_is
  FloatGrid.upper_is
  FloatGrid.float_length_is
  Needed.smaller_cap_misses
  Needed.tie_upward_misses
  Needed.no_carry_misses
  Needed.tetrahedron_is_closed
  Needed.closed_test_is_odd
  Needed.one_component_is_odd
  Needed.both_components_are_even
)
closed='Closed under the global context'

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
compile() {
  coqc -q -Q . HitpipeMajor "$1.v"
}

for file in "${files[@]}"; do
  cp "$here/$file.v" .
  compile "$file"
done

printf 'From HitpipeMajor Require Import %s.\n' "${files[*]}" >Assumptions.v
printf 'Print Assumptions %s.\n' "${theorems[@]}" >>Assumptions.v
compile Assumptions >assumptions
if [[ $(wc -l <assumptions) -ne ${#theorems[@]} ]] || grep -qvx "$closed" assumptions; then
  cat assumptions
  echo 'prove.sh: a theorem assumes an axiom' >&2
  exit 1
fi
for theorem in "${theorems[@]}"; do printf '%-44s %s\n' "$theorem" "$closed"; done

sources=("$root"/rays/{exact/major_quotient,world/{int_major_ray,int_box,ray_check}}.cpp)
"${CXX:-c++}" -std=c++20 -O1 -I"$root" "$here/emit_cases.cpp" "${sources[@]}" -lfmt -o emit_cases
"${CXX:-c++}" -std=c++20 -O1 -I"$root" "$here/emit_walks.cpp" -lfmt -o emit_walks
./emit_cases "$cases" >Cases.v
./emit_walks "$cases" >Walks.v
# counted FILE WHAT: what FILE prints are how many cases agree, and how many of these are WHAT.
counted() {
  compile "$1" | tr '\n' ' ' | sed 's/ = /\n/g' | sed -n "s/.*(\([0-9]*\)[^,]*, \([0-9]*\).*/\1 cases agree with the C++, \2 of them $2/p"
}
counted Cases HIT
counted Walks 'with restarts'
