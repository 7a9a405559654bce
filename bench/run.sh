#!/bin/sh
# Runs every benchmark of the release build. Figures of one run on one machine: compare them with each other.
set -eu
cd "$(dirname "$0")/.."
for program in num_bench fp_bench box_test_bench exact_bench traversal_bench build_bench rtl_bench check_bench memory_bench core_bench; do
  echo "== $program"
  "build/bench/$program" --benchmark_color=false "$@"
done
echo "== rays_bench"
build/bench/rays_bench
