#!/usr/bin/env bash
# Proves properties of a whole core for two rays, with yosys and yosys-abc: prove_core.sh HITPIPE FOLDER
# tests/formal/core/ has the properties: as text inside the core or its wrapper, or as a module around two cores. A
# reached row must find a run that meets all assumptions. Prints a table of row, result, cycles, seconds; false when
# anything was not proved, or when damage was not found. A row is known if proved.txt has its text.
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/proofs.sh"
hitpipe=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
cd "$2" || exit 1
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

# text PLACE DEFINES DAMAGE: p.v and p.ys, which makes p.aig of it and of the text that PLACE says.
text() {
  local place=$1 defines=$2 damage=$3 file=../wide/core.v read top=core
  local units="delete core_pair core_triangle; read_verilog -formal -I$texts"
  [[ $place != twice ]] || file=../narrow/core.v
  [[ $place != axi* ]] || file=../${place/axi/wide}/core_axi.v
  cp "$file" p.v
  [[ -z $damage ]] || { sed -i "$damage" p.v; ! cmp -s p.v "$file" || return 1; }
  case $place in
    twice)
      top=twice
      read="read_verilog -formal p.v; $units $texts/same_units.v; read_verilog -formal $defines $texts/twice.v"
      ;;
    axi*)
      top=core_axi
      inside p.v "$texts/axi.v" >p.whole.v
      { sed -n '/^module core /,/^);/p' ../wide/core.v; echo endmodule; } >p.ports.v  # its inside plays no part
      read="read_verilog -noblackbox p.ports.v; hierarchy -top core; cutpoint core; read_verilog -formal $defines p.whole.v"
      ;;
    *)
      inside p.v "$texts/$place.v" >p.whole.v
      read="read_verilog -formal $defines p.whole.v; $units $texts/any_units.v"
      ;;
  esac
  echo "$read; hierarchy -check -top $top; prep -flatten -top $top; delete -output o:*; memory_map; opt -full;
    techmap; opt -fast; dffunmap; dfflegalize -cell \$_DFF_P_ 01; abc -g AND -fast; opt_clean;
    write_aiger -zinit p.aig" >p.ys
}
# whole WORD...: whether the text was proved, or its damage found, before.
whole() {
  local file files=()
  for file in "$texts"/*.v; do [[ $file == */axi.v ]] || files+=("$file"); done  # p.whole.v has that one
  known "$@" "$(declare -f checked bounded found always)" "$(sed "s|$texts||g" p.ys)" p*.v "${files[@]}"
}
model() {
  yosys -q -p "$(<p.ys)" >p.log 2>&1
}

row() {
  local what=$1 result=$2 cycles=$3 began=$4
  printf '%-52s %-10s %6s %8s\n' "$what" "$result" "$cycles" \
    "$(awk -v a="$began" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')"
  [[ $result != NOT* ]]
}

# checked COMMAND: of yosys-abc.
checked() {
  yosys-abc -c "read_aiger p.aig; fold; strash; scorr; $1" >>p.log 2>&1
}
# No assertion fails in so many cycles, or one does.
bounded() {
  checked "bmc3 -F $1" && grep -q "No output asserted in $1 frames" p.log
}
found() {
  checked "bmc3 -F $1" && grep -q 'was asserted in frame' p.log
}
# Unbounded, by property-directed reachability.
always() {
  checked 'pdr -T 300' && grep -q '^Property proved' p.log
}

# proof PLACE DEFINES WHAT CYCLES|any DAMAGE: and the damage is found, in as many cycles or in 20.
proof() {
  beside proof_row "${@:1:4}"
  damage "$1" "$2" "${3%%:*}: damage" "$4" "$5"
}
proof_row() {
  local cycles=$4 began=$EPOCHREALTIME result='NOT PROVED'
  text "$1" "$2" '' &&
    if whole proof "$cycles"; then result=known; else
      model && if [[ $cycles == any ]]; then always; else bounded "$cycles"; fi && result=proved
    fi
  row "$3" "$result" "$cycles" "$began"
}
damage() {
  beside damage_row "$@"
}
damage_row() {
  local cycles=${4/any/20} began=$EPOCHREALTIME result='NOT FOUND'
  text "$1" "$2" "$5" && if whole damage "$cycles"; then result=known; else model && found "$cycles" && result=found; fi
  row "$3" "$result" "$cycles" "$began"
}
# reached PLACE DEFINES WHAT CYCLES
reached() {
  beside reached_row "$@"
}
reached_row() {
  local began=$EPOCHREALTIME result='NOT REACHED'
  text "$1" "$2" '' && if whole reached "$4"; then result=known; else model && found "$4" && result=reached; fi
  row "$3" "$result" "$4" "$began"
}

emit wide --tag-bits 2
emit narrow --tag-bits 1
emit wide_64 --tag-bits 2 --data-bits 64

printf '%-52s %-10s %6s %8s\n' proof result cycles seconds
# The dearest first, so that none runs alone at the end.
all='-DHELD=1 -DANSWERS -DSTAYS -DINSIDE -DONCE'
proof answers "$all" 'all four: one cycle held back' 58 's/tags\[leaving_ray\]/tags[0]/'
reached answers '-DHELD=1 -DREACHED' 'all four: two rays have met a triangle' 58
proof answers -DANSWERS 'answers: once, with its tag, none of before a reset' 34 's/tags\[leaving_ray\]/tags[0]/'
proof answers -DSTAYS 'stays: answers and requests until they are taken' 34 \
  's/next_there_1_value = holds ? there_1 : requests_mux/next_there_1_value = requests_mux/'
proof answers -DINSIDE 'inside: no block behind the last, or before the first' 36 's/wire reader_cmp = .*/wire reader_cmp = 0;/'
proof answers -DONCE 'once: one request of a ray at a time' 34 's/missed_there & ~divided_there/~divided_there/'
proof ends -DMOST=46 'ends: a ray is answered 46 cycles after it was taken' 66 's/wire misses = tested & ~hit/& \& tester/'
reached ends -DMOST=45 'ends: one takes 45' 66
proof twice -DHELD=1 'twice: other times, the same answers' 53 's/numbers\[read_ray\]/numbers[0]/'
reached twice '-DHELD=1 -DREACHED' 'twice: two rays have met a triangle' 52
for place in axi axi_64; do
  ids=-DREAD_VALID=beats_read_valid
  [[ $place == axi_64 ]] || ids='-DIDS -DREAD_VALID=core_read_valid'
  proof $place "-DSTAYS $ids" "$place: what is offered stays" any \
    's/offers_requests <= next_offers_requests_value/offers_requests <= ~stopping/'
  proof $place "-DBURST $ids" "$place: no burst over 4 KiB" any "s/arsize = 3'h/arsize = 3'h1 + 3'h/"
  proof $place "-DLITE $ids" "$place: each access of lite is answered once" any \
    's/written <= next_written_value/written <= next_has_word_value/'
  proof $place "-DEMPTIES $ids" "$place: a soft reset finds memory quiet" any 's/still_and_2 & still_eq/still_and_2/'
  reached $place "-DREACHED $ids" "$place: a soft reset with two rays in the core" 20
  [[ $ids == *IDS* ]] || continue
  proof $place "-DEPOCH $ids" "$place: no block of before a hard reset" any 's/ & (m_axi_rid\[3:2\] == epoch_present)//'
  damage $place "-DEPOCH $ids" "$place: an epoch that does not change" any 's/epoch_r <= next_epoch_r_value/epoch_r <= epoch_r/'
  reached $place "-DOLD $ids" "$place: a block of three resets ago comes" 20
done
finish_beside core
