#!/usr/bin/env bash
# Proves properties of machines with yosys and z3, by induction, for two or four rays: prove_machines.sh HITPIPE FOLDER
# Which, in which formats, with which damage: what the features of the core promise (rtl_gen/core/feature.hpp).
# tests/formal/machines/NAME.v has the properties of a machine, as text inside its module; NAME_FORMAT.v is text before
# it, of one format, and NAME_FORMAT_alone.v is in its place. Two machines may include a text. A product may be any number.
# Prints a table of machine, format, result, seconds; false when anything was not proved, or when damage was not found. A row
# is known if proved.txt has its text.
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/proofs.sh"
hitpipe=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
cd "$2" || exit 1

# width LETTER USUAL FORMAT: a localparam's value, the format's number behind the letter.
width() {
  [[ $3 =~ [0-9]$1([0-9]+) ]] && echo "${BASH_REMATCH[1]}" || echo "$2"
}
# text NAME FORMAT [DAMAGE]: the machine's Verilog with its properties, changed by an expression of sed.
text() {
  local name=$1 format=$2 damage=${3:-}
  local texts=("$formal/machines/$name.v")
  [[ ! -f $formal/machines/${name}_$format.v ]] || texts=("$formal/machines/${name}_$format.v" "${texts[@]}")
  [[ ! -f $formal/machines/${name}_${format}_alone.v ]] || texts=("$formal/machines/${name}_${format}_alone.v")
  "$hitpipe" rtl "$name" --bits "$format" --name "$name" --vectors 1 --out . >rtl.log || return 1
  cp "$name.v" whole.v
  [[ -z $damage ]] || { sed -i "$damage" "$name.v"; ! cmp -s "$name.v" whole.v || return 1; }
  sed -i '/^endmodule/d' "$name.v"
  {
    echo '  reg was_reset = 1'\''b0;'
    echo '  always @(posedge clk) was_reset <= was_reset | rst;'
    echo '  always @* if (!was_reset) assume (rst);'
    echo "  localparam LEAF_BITS = $(width e 8 "$format"), NUMBER_BITS = $(width u 32 "$format"), STEP_BITS = $(width s 20 "$format");"
    cat "${texts[@]}"
    echo endmodule
  } >>"$name.v"
}
# whole NAME WORD: whether the text was proved, or its damage found, before.
whole() {
  known "$2" "$(declare -f holds reached)" "$1.v" "$formal/covers.v" "$formal/machines/triangle_queue.v"
}
# model NAME: NAME.smt2.
model() {
  local name=$1
  yosys -q -p "read_verilog -formal -I$formal/machines $name.v; prep -top $name; cutpoint t:\$mul; memory_map; opt_clean; write_smt2 -wires $name.smt2" >"$name.log" 2>&1
}

solve() {
  yosys-smtbmc --noprogress -s z3 "${symbolic[@]}" "$@"
}
# holds NAME STEPS: from the first reset on, whatever comes before, by induction with so many steps, or up to four.
holds() {
  solve -i -t "$2:4" "$1.smt2" >>"$1.log" 2>&1 && solve --presat -t 4 "$1.smt2" >>"$1.log" 2>&1
}
# Every cover is met. yosys-abc finds runs to them in seconds, and z3 in minutes.
reached() {
  yosys -q -p "read_verilog -formal -I$formal/machines $1.v; prep -top $1; chformal -assert -remove
    techmap -map $formal/covers.v t:\$cover; cutpoint t:\$mul; delete -output o:*; opt_clean -purge; memory_map
    setundef -zero; simplemap; techmap; dffunmap; dfflegalize -cell \$_DFF_P_ 01; aigmap; opt_clean
    write_aiger -zinit $1.aig" >"$1.cover.log" 2>&1 &&
    yosys-abc -c "read_aiger $1.aig; fold; strash; bmc3 -a -x -F 30" >>"$1.cover.log" 2>&1 &&
    grep -q 'outputs are found to be SAT' "$1.cover.log"
}

row() {
  local what=$1 format=$2 result=$3 began=$4
  printf '%-52s %-19s %-10s %6s\n' "$what" "$format" "$result" \
    "$(awk -v a="$began" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')"
  [[ $result != NOT* ]]
}

# damage NAME FORMAT WHAT EXPRESSION: what fails with four steps fails with fewer.
damage() {
  beside damage_row "$@"
}
damage_row() {
  local began=$EPOCHREALTIME result='NOT FOUND'
  text "$1" "$2" "$4" &&
    if whole "$1" damage; then result=known; else
      model "$1" && ! holds "$1" 4 && grep -q 'Status: FAILED' "$1.log" && result=found
    fi
  row "$1: $3" "$2" "$result" "$began"
}
# proof NAME FORMAT WHAT
proof() {
  beside proof_row "$@"
}
proof_row() {
  local began=$EPOCHREALTIME result='NOT PROVED'
  text "$1" "$2" &&
    if whole "$1" proof; then result=known; else
      model "$1" && holds "$1" 2 && reached "$1" && result=proved
    fi
  row "$1: $3" "$2" "$result" "$began"
}

printf '%-52s %-19s %-10s %6s\n' proof format result seconds
# Machines of the core, as its features promise.
promises=$("$formal/promises.py" "$hitpipe") || exit 1
while IFS=$'\t' read -r row of; do
  IFS=$'\t' read -ra words <<<"$of"
  "$row" "${words[@]}"
done <<<"$promises"
proof scene_memory a4i1 'a block a request, as written'
damage scene_memory a4i1 damage "s/free = count == /free = 1'b1 | count == /"
finish_beside machines
