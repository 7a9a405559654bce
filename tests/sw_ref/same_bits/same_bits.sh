#!/usr/bin/env bash
# Every compiler's answers to rays are the same bits: same_bits.sh FOLDER COMPILER...
# Each compiler builds answers.cpp and what it needs at -O0 and -O3, and each program runs with 1 and 7 threads.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
folder=$1
shift
mkdir -p "$folder"
cd "$folder"
{
  for source in "$root"/host/{parallel,default_arithmetic,watch}.cpp "$root"/sw_ref/judge/*.cpp \
    "$root"/sw_ref/quantise/{coarse_axes,float_ray,fp_box,fp_slabs_safe_ray,int_box,int_major_ray}.cpp \
    "$root"/sw_ref/quantise/{int_plucker_ray,int_slabs_ray,major_quotient,ray_check}.cpp \
    "$root"/sw_ref/hierarchy/{build,split,small_leaves,wide_nodes}.cpp "$root"/sw_ref/mesh/closed.cpp \
    "$root"/sw_ref/scene/{normalise,triangle_numbers}.cpp \
    "$root"/sw_ref/trace/{datapath_tests,fast_scene,fast_tracer,float_queries,leaf_test}.cpp \
    "$root"/sw_ref/world/{crossing,int_fast_scene,int_meets,int_mesh,int_queries,int_ray,int_tracer}.cpp \
    "$root"/sw_ref/world/{int_triangle,mesh_crossings,quick_crossing}.cpp; do
    echo "#include \"$source\""
  done
  echo "#include \"$root/tests/sw_ref/same_bits/answers.cpp\""
} >all.cpp

failed=0
first=
for compiler in "$@"; do
  for level in -O0 -O3; do
    flags=(-std=c++20 "$level" -ffp-contract=off -w -I"$root")
    wide=()
    [[ $(uname -m) != x86_64 ]] || wide=(-mavx2)
    "$compiler" "${flags[@]}" "${wide[@]}" -O2 -c "$root/sw_ref/trace/fast_trace_avx2.cpp" -o wide.o
    "$compiler" "${flags[@]}" all.cpp wide.o -lfmt -o answers
    for threads in 1 7; do
      sums=$(./answers "$threads" | sort -u)
      printf '%-12s %s, threads %s: %s\n' "$(basename "$compiler")" "$level" "$threads" "$sums"
      [[ $(wc -l <<<"$sums") == 1 && ${first:=$sums} == "$sums" ]] || failed=1
    done
  done
done
exit $failed
