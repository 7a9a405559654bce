#!/usr/bin/env bash
# Proves with Coq that int_major and int_major_pair never miss, in all widths and both worlds: prove.sh.
# docs/formal.md explains.
# It prints what each theorem assumes, and compares the definition with the C++ on random rays.
# It fails if a proof fails, if a theorem assumes an axiom, or if a case differs.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
cases=500

files=(Numbers IntMajor SetUp FloatQuotient FloatGrid NeverMisses IntegerWorld Words Shifter Datapath Ranges Pair
  IntegerTriangle Triangle TriangleHit Divider Needed Compare)
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

sources=("$root"/sw_ref/quantise/{int_major_ray,major_quotient,int_box,ray_check}.cpp)
"${CXX:-c++}" -std=c++20 -O1 -I"$root" "$here/emit_cases.cpp" "${sources[@]}" -lfmt -o emit_cases
./emit_cases "$cases" >Cases.v
compile Cases | tr '\n' ' ' | sed 's/ = /\n/g' |
  sed -n 's/.*(\([0-9]*\)[^,]*, \([0-9]*\).*/\1 cases agree with the C++, \2 of them HIT/p'
