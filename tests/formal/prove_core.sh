#!/usr/bin/env bash
# Proves properties of a whole core for two rays, with yosys and yosys-abc: prove_core.sh HITPIPE FOLDER
# tests/formal/core/ has the properties: as text inside the core or its wrapper, or as a module around two cores. A
# reached row must find a run that meets all assumptions. Prints a table of row, result, cycles, seconds; false when
# anything was not proved, or when damage was not found.
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/proofs.sh"
hitpipe=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
cd "$2" || exit 1
failed=0
texts=$formal/core

# emit FOLDER OPTION...: the smallest core. The divider takes one cycle, and its quotient is its numerator.
emit() {
  local folder=$1
  shift
  "$hitpipe" core rtl --bits 8+0/4s8 --rays 2 --stack 2 --levels 2 --block-bits 4 --address-bits 9 --name core "$@" \
    --out "$folder" >"$folder.log" || exit 1
  cp "$folder/core.v" emitted.v
  sed -i -e 's/wire \[7:0\] next_quotient_value = .*/wire [7:0] next_quotient_value = loads ? nums_word[7:0] : quotient;/' \
    -e "s/loads ? 3'h4 : next_left_value_sub/loads ? 3'h1 : next_left_value_sub/" "$folder/core.v"
  [[ $(diff emitted.v "$folder/core.v" | grep -c '^>') == 2 ]] || exit 1
}

# inside FILE TEXT: the text at the end of the file's first module.
inside() {
  awk -v text="$2" '/^endmodule/ && !done { while ((getline line < text) > 0) print line; done = 1 } { print }' "$1"
}

# model NAME PLACE DEFINES DAMAGE: NAME.aig, of the text that PLACE says.
model() {
  local name=$1 place=$2 defines=$3 damage=$4 file=wide/core.v read top=core
  local units="delete core_pair core_triangle; read_verilog -formal -I$texts"
  [[ $place != twice ]] || file=narrow/core.v
  [[ $place != axi* ]] || file=${place/axi/wide}/core_axi.v
  cp "$file" "$name.v"
  [[ -z $damage ]] || { sed -i "$damage" "$name.v"; ! cmp -s "$name.v" "$file" || return 1; }
  case $place in
    twice)
      top=twice
      read="read_verilog -formal $name.v; $units $texts/same_units.v; read_verilog -formal $defines $texts/twice.v"
      ;;
    axi*)
      top=core_axi
      inside "$name.v" "$texts/axi.v" >"$name.whole.v"
      read="read_verilog -formal wide/core.v; hierarchy -top core; cutpoint core; read_verilog -formal $defines $name.whole.v"
      ;;
    *)
      inside "$name.v" "$texts/$place.v" >"$name.whole.v"
      read="read_verilog -formal $defines $name.whole.v; $units $texts/any_units.v"
      ;;
  esac
  yosys -q -p "$read; hierarchy -check -top $top; prep -flatten -top $top; delete -output o:*; memory_map; opt -full;
    techmap; opt -fast; dffunmap; dfflegalize -cell \$_DFF_P_ 01; abc -g AND -fast; opt_clean;
    write_aiger -zinit $name.aig" >"$name.log" 2>&1
}

row() {
  local what=$1 result=$2 cycles=$3 began=$4
  [[ $result == NOT* ]] && failed=1
  printf '%-52s %-10s %6s %8s\n' "$what" "$result" "$cycles" \
    "$(awk -v a="$began" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')"
}

# checked NAME COMMAND: of yosys-abc.
checked() {
  timeout 600 yosys-abc -c "read_aiger $1.aig; fold; strash; scorr; $2" >>"$1.log" 2>&1
}
# No assertion fails in so many cycles, or one does.
bounded() {
  checked "$1" "bmc3 -F $2" && grep -q "No output asserted in $2 frames" "$1.log"
}
found() {
  checked "$1" "bmc3 -F $2" && grep -q 'was asserted in frame' "$1.log"
}
# Unbounded, by property-directed reachability.
always() {
  checked "$1" 'pdr -T 300' && grep -q '^Property proved' "$1.log"
}

number=0
# proof PLACE DEFINES WHAT CYCLES|any DAMAGE: and the damage is found, in as many cycles or in 20.
proof() {
  local place=$1 defines=$2 what=$3 cycles=$4 damage=$5 name=p$((++number)) began=$EPOCHREALTIME result='NOT PROVED'
  model "$name" "$place" "$defines" '' &&
    if [[ $cycles == any ]]; then always "$name"; else bounded "$name" "$cycles"; fi && result=proved
  row "$what" "$result" "$cycles" "$began"
  damage "$place" "$defines" "${what%%:*}: damage" "$cycles" "$damage"
}
damage() {
  local place=$1 defines=$2 what=$3 cycles=${4/any/20} damage=$5 name=p$((++number)) began=$EPOCHREALTIME result='NOT FOUND'
  model "$name" "$place" "$defines" "$damage" && found "$name" "$cycles" && result=found
  row "$what" "$result" "$cycles" "$began"
}
# reached PLACE DEFINES WHAT CYCLES
reached() {
  local name=p$((++number)) began=$EPOCHREALTIME result='NOT REACHED'
  model "$name" "$1" "$2" '' && found "$name" "$4" && result=reached
  row "$3" "$result" "$4" "$began"
}

emit wide --tag-bits 2
emit narrow --tag-bits 1
emit wide_64 --tag-bits 2 --data-bits 64

printf '%-52s %-10s %6s %8s\n' proof result cycles seconds
proof answers -DANSWERS 'answers: once, with its tag, none of before a reset' 34 's/tags\[leaving_ray\]/tags[0]/'
proof answers -DSTAYS 'stays: answers and requests until they are taken' 34 \
  's/next_there_1_value = holds ? there_1 : requests_mux/next_there_1_value = requests_mux/'
proof answers -DINSIDE 'inside: no block behind the last, or before the first' 36 's/wire reader_cmp = .*/wire reader_cmp = 0;/'
proof answers -DONCE 'once: one request of a ray at a time' 34 's/missed_there & ~divided_there/~divided_there/'
all='-DHELD=1 -DANSWERS -DSTAYS -DINSIDE -DONCE'
proof answers "$all" 'all four: one cycle held back' 58 's/tags\[leaving_ray\]/tags[0]/'
reached answers '-DHELD=1 -DREACHED' 'all four: two rays have met a triangle' 58
proof ends -DMOST=46 'ends: a ray is answered 46 cycles after it was taken' 66 's/wire misses = tested & ~hit/& \& tester/'
reached ends -DMOST=45 'ends: one takes 45' 66
proof twice -DHELD=1 'twice: other times, the same answers' 53 's/numbers\[read_ray\]/numbers[0]/'
reached twice '-DHELD=1 -DREACHED' 'twice: two rays have met a triangle' 52
for place in axi axi_64; do
  ids=
  [[ $place == axi_64 ]] || ids=-DIDS
  proof $place "-DSTAYS $ids" "$place: what is offered stays" any \
    's/offers_requests <= next_offers_requests_value/offers_requests <= ~stopping/'
  proof $place "-DBURST $ids" "$place: no burst over 4 KiB" any "s/arsize = 3'd/arsize = 3'd1 + 3'd/"
  proof $place "-DLITE $ids" "$place: each access of lite is answered once" any \
    's/written <= next_written_value/written <= next_has_word_value/'
  proof $place "-DEMPTIES $ids" "$place: a soft reset finds memory quiet" any 's/still_and_2 & still_eq/still_and_2/'
  reached $place "-DREACHED $ids" "$place: a soft reset with two rays in the core" 20
done
exit $failed
