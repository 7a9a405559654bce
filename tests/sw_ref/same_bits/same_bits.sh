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
  for source in "$root"/host/{parallel,default_arithmetic,text,watch}.cpp "$root"/rays/{exact,scene,tree,world,trace}/*.cpp \
    "$root"/sw_ref/quantise/{float_ray,fp_box,fp_slabs_safe_ray,int_plucker_ray,int_slabs_ray}.cpp \
    "$root"/sw_ref/trace/datapath_tests.cpp; do
    [[ $source == *_avx2.cpp ]] || echo "#include \"$source\""
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
    "$compiler" "${flags[@]}" "${wide[@]}" -O2 -c "$root/rays/trace/fast_trace_avx2.cpp" -o wide.o
    "$compiler" "${flags[@]}" all.cpp wide.o -lfmt -o answers
    for threads in 1 7; do
      sums=$(./answers "$threads" | sort -u)
      printf '%-12s %s, threads %s: %s\n' "$(basename "$compiler")" "$level" "$threads" "$sums"
      [[ $(wc -l <<<"$sums") == 1 && ${first:=$sums} == "$sums" ]] || failed=1
    done
  done
done
exit $failed
