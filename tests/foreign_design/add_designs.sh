#!/usr/bin/env bash
# The steps of "Add a design" in docs/designs.md, as a user takes them in a copy of the tree: the design of this folder under
# another name, and a copy of int_slabs with one line changed.
# Usage: add_designs.sh SOURCE_FOLDER WORK_FOLDER C++_COMPILER
set -euo pipefail
source=$1 work=$2 copy=$2/tree
export HITPIPE_CACHE=$work/models
rm -rf "$copy"
mkdir -p "$copy"
tar -C "$source" --exclude='./build*' --exclude=./.git --exclude=./out -cf - . | tar -C "$copy" -xf -
cd "$copy"

fail() {
  echo "$*" >&2
  exit 1
}

# The design as a user would write it: user_slabs.
(cd tests/foreign_design && find hls rtl_gen sim -type f) | while read -r file; do
  sed 's/block/user/g; s/Block/User/g' "tests/foreign_design/$file" >"${file//block/user}"
done
sed 's/block/user/g; s/Block/User/g' tests/foreign_design/docs/operands.md >>docs/operands.md
sed -i 's/^  fp_slabs_safe$/&\n  user_slabs/' designs.cmake

# They are the files that the page names, each in a row of its table.
sed -n '/^## Add a design/,/^## /p' docs/designs.md | sed -n 's/^| `\([^`]*\)` |.*/\1/p' |
  grep -E '[/.]' | sed 's/NAME/user_slabs/' | sort >"$work/named"
{ diff -rq "$source" . --exclude='build*' --exclude=.git --exclude=out || true; } |
  sed -n -e 's|^Files .* and \./\(.*\) differ$|\1|p' -e 's|^Only in \./\{0,1\}\(.*\): \(.*\)$|\1/\2|p' | sort >"$work/added"
diff "$work/named" "$work/added" || fail 'docs/designs.md names other files (<) than a design needs (>)'

# A copy of int_slabs that takes the ray's end for its opposite.
for file in hls/box/int_slabs_operands.hpp hls/pipelines/int_slabs.hpp rtl_gen/designs/int_slabs.cpp; do
  sed 's/int_slabs/my_slabs/g; s/IntSlabs/MySlabs/g' "$file" >"${file/int_slabs/my_slabs}"
done
sed -i 's/Bit(irlen < near)/Bit(near < irlen)/' hls/pipelines/my_slabs.hpp
sed 's/IntSlabsSetup/MySlabsSetup/g; s/int_slabs_\(software\|tracer\|named\)/my_slabs_\1/g' sim/designs/int_slabs.cpp \
  >sim/designs/my_slabs.cpp
sed -i 's/^  user_slabs$/&\n  my_slabs/' designs.cmake

# Without optimisation every inline function of two designs that share a name stays one.
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_CXX_COMPILER="$3" -DHITPIPE_TESTS=OFF -DHITPIPE_BENCH=OFF >"$work/configure.log"
cmake --build build --target hitpipe
hitpipe=build/hitpipe

"$hitpipe" rtl int_slabs --out "$work/rtl"
"$hitpipe" rtl my_slabs --out "$work/rtl"
sed 's/my_slabs/int_slabs/g' "$work/rtl/my_slabs.v" | diff "$work/rtl/int_slabs.v" - >"$work/changed" &&
  fail 'the changed copy has the Verilog of int_slabs'
grep '^[<>]' "$work/changed" | grep -vE 'near.*<.*irlen|irlen.*<.*near|^. *//' && fail 'more than the changed line is new'

small=(--scene spheres --width 24 --height 24)
"$hitpipe" cosim int_slabs "${small[@]}" --referee >/dev/null || fail 'the referee reports int_slabs'
"$hitpipe" cosim my_slabs "${small[@]}" --referee >"$work/my_slabs.txt" 2>&1 && fail 'the referee reports nothing'
grep -E 'false miss' "$work/my_slabs.txt" || fail 'no false miss is reported'

"$hitpipe" cosim user_slabs "${small[@]}" --referee >/dev/null || fail 'the referee reports user_slabs'
"$hitpipe" sweep "${small[@]}" fp_slabs,user_slabs --out "$work/rows.csv" >/dev/null
grep -c ',user_slabs,' "$work/rows.csv" || fail 'the sweep has no row of user_slabs'
"$hitpipe" check user_slabs --tests 20000 >/dev/null || fail 'user_slabs misses a box'
