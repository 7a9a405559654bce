#!/usr/bin/env bash
# The steps of "Add a design" in docs/designs.md, as a user takes them in a copy of the tree: the design of this folder under
# another name, and a copy of int_slabs. The copy answers wrongly at first, which the referee sees. With "tests", all tests pass with
# both when the copy is mended.
# Usage: add_designs.sh SOURCE_FOLDER WORK_FOLDER [tests]
set -euo pipefail
source=$1 work=$2 copy=$2/tree tests=${3:-}
export HITPIPE_CACHE=$work/models
rm -rf "$copy"
mkdir -p "$copy"
tar -C "$source" --exclude='./build*' --exclude=./out -cf - . | tar -C "$copy" -xf -
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

# copy NAME STRUCT: a copy of int_slabs with that name. What the thesis prints is of the original alone.
copy() {
  for file in hls/box/int_slabs_operands.hpp hls/pipelines/int_slabs.hpp rtl_gen/designs/int_slabs.cpp; do
    sed "s/int_slabs/$1/g; s/IntSlabs/$2/g; /The 20.24 row/d; /design.printed/,/};/d" "$file" >"${file/int_slabs/$1}"
  done
  sed "s/IntSlabsSetup/$2Setup/g; /^#include/!s/int_slabs_/$1_/g" sim/designs/int_slabs.cpp >"sim/designs/$1.cpp"
  sed -n '/^### int_slabs/,/^### /p' docs/operands.md | sed "\$d; s/int_slabs/$1/g" >>docs/operands.md
  sed -i "s/^  user_slabs$/&\n  $1/" designs.cmake
}

# One that takes the ray's end for its opposite.
copy my_slabs MySlabs
sed -i 's/Bit(irlen < near)/Bit(near < irlen)/' hls/pipelines/my_slabs.hpp

# Here the program runs for seconds, so nothing is optimised. A target adds its own level to Release, and an -O0 header does not serve it.
fast=()
[ "$tests" = tests ] || fast=(-DHITPIPE_TESTS=OFF -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG='-O0 -DNDEBUG')
cmake --preset release -DHITPIPE_BENCH=OFF "${fast[@]}" >"$work/configure.log"
build() {
  cmake --build build -j "$(nproc)" "$@" >"$work/build.log" 2>&1
}
build --target hitpipe || { tail -n 40 "$work/build.log" && fail 'the copy does not compile'; }
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

# As it should be, and with all tests.
sed -i 's/Bit(near < irlen)/Bit(irlen < near)/' hls/pipelines/my_slabs.hpp
if [ "$tests" = tests ]; then
  build || { tail -n 40 "$work/build.log" && fail 'the tests of the copy do not compile'; }
  ctest --preset release -j "$(nproc)" -LE long >"$work/tests.log" || { tail -n 60 "$work/tests.log" && fail 'tests fail with two more designs'; }
  tail -n 3 "$work/tests.log"
fi

# A copy in the namespace of the original would give one of them for both: it does not compile.
copy same_slabs SameSlabs
sed -i 's/namespace same_slabs/namespace int_slabs/; s/using same_slabs::/using int_slabs::/' hls/pipelines/same_slabs.hpp
build --target hitpipe_rtl_gen -- -k 0 && fail 'a copy in the namespace of the original compiles'
grep -m 1 'redefinition of .*int_slabs' "$work/build.log" || fail 'the compiler does not name the function that is there twice'
