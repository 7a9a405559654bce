#!/bin/sh
# Draws the schematics that docs/designs.md and docs/core.md show: docs/schematics.sh. It takes Graphviz.
set -eu
cd "$(dirname "$0")/.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
for unit in fp_slabs=fp32 int_slabs=24/24 fp_plucker=fp32 int_plucker=24/24 int_major=20+1/13 int_major_pair=20+1/13; do
  build/hitpipe rtl "${unit%%=*}" --bits "${unit#*=}" --out "$out" >/dev/null
done
build/hitpipe core rtl --name core --out "$out" >/dev/null
build/hitpipe rtl walker --out "$out" >/dev/null
rm -f docs/schematics/*.svg
for picture in $(grep -oh '(schematics/[^)]*\.svg)' docs/designs.md docs/core.md | tr -d '()'); do
  cp "$out/${picture#schematics/}" "docs/$picture"
done
