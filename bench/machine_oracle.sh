#!/bin/sh
# Holds machines against an older state of the tree while their C++ takes another form.
#   bench/machine_oracle.sh save FOLDER [MACHINE...]          before the change
#   bench/machine_oracle.sh compare FOLDER NEW [MACHINE...]   after it; NEW is another folder
# Compared are Verilog, manifest, picture, testbench and vectors, the graph, and all outputs and registers of
# 10^6 random cycles, of each machine in two formats or three. Names of source lines do not count.
# BUILD=DIR is where the program machine_oracle has been built; else build/.
set -eu
cd "$(dirname "$0")/.."
formats='door=t20i5 door=t13i3
triangle_feed=20+1s20i5 triangle_feed=16+2s11t2b1i3
requests=a24h32i5 requests=a10h40i3
scene_memory=a12i1 scene_memory=a5i3
replies=t20g16i5 replies=t21g7i3
beats=d64i5 beats=d256i3 beats=d512i2
divider=20+1s20i5 divider=16+2s11t2b1i3
reader=a24i5 reader=a13i3
weights=d61e62t20g16i5 weights=d44e45t17g9i3
best_hits=t20c1d20i5 best_hits=t17c2d19i3
pair_feed=20+1/11a24i5 pair_feed=16+2/9a13i3
registers=a24h32i5c40 registers=a13h40i3c64
serial_triangle=20+1s20i5 serial_triangle=16+2s11t2b1i3
walker=d20a24l60k3i5 walker=d17a13l20k2i3'
what=$1 folder=$2
mkdir -p "$folder"
shift 2
new=$folder
if [ "$what" = compare ]; then
  new=$1
  mkdir -p "$new"
  shift
fi
wanted=$formats
if [ $# -gt 0 ]; then
  wanted=
  for machine; do wanted="$wanted $(echo "$formats" | tr ' ' '\n' | grep "^$machine=")"; done
fi
# shellcheck disable=SC2086
"${BUILD:-build}/bench/machine_oracle" "$new" $wanted
[ "$what" = compare ] || exit 0

plain() { sed -E 's,(hls/machines/)?[a-z_]+[.]hpp[: ][0-9]+,SOURCE,g' "$1"; }
for machine in $(echo $wanted | tr ' ' '\n' | cut -d= -f1 | uniq); do
  for file in "$folder"/*."$machine".* "$folder"/*."tb_$machine"*; do
    name=$(basename "$file")
    plain "$file" >"$new/.old"
    plain "$new/$name" >"$new/.new"
    if cmp -s "$new/.old" "$new/.new"; then
      echo "same $name"
    else
      echo "DIFFERS $name: $(diff "$new/.old" "$new/.new" | grep -c '^[<>]') of $(wc -l <"$new/.old") lines"
    fi
  done
done
