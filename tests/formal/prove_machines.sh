#!/usr/bin/env bash
# Proves properties of machines with yosys and z3, by induction, for two or four rays: prove_machines.sh HITPIPE FOLDER
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
  printf '%-44s %-19s %-10s %6s\n' "$what" "$format" "$result" \
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
# machine NAME FORMAT WHAT DAMAGE
machine() {
  beside machine_row "$1" "$2" "$3"
  damage "$1" "$2" damage "$4"
}
machine_row() {
  local began=$EPOCHREALTIME result='NOT PROVED'
  text "$1" "$2" &&
    if whole "$1" proof; then result=known; else
      model "$1" && holds "$1" 2 && reached "$1" && result=proved
    fi
  row "$1: $3" "$2" "$result" "$began"
}

printf '%-44s %-19s %-10s %6s\n' proof format result seconds
# The dearest first, so that none runs alone at the end.
# Forgets the error of a first beat.
machine cache a5h10i2s1w4l2d256m1 'the same with identifiers' 's/beat_failed = .*;/beat_failed = beat_error;/'
# Joins in the cycle in which the list is taken.
machine cache a4h9i2s1w2l2d256 'a block a ray, as memory has it' \
  's/may_join = look_there & ~fills/may_join = look_there/'
damage cache a4h9i2s1w2l2d256 'beats while a list is given' \
  's/takes_beat_and = ~gives_list \& ~empties/takes_beat_and = ~empties/'
damage cache a4h9i2s1w2l2d256 'a line with an error stays' "s/value_and \& fill_error/value_and \& 1'b0/"
machine rings h9g1t4d64 'rays and answers once, as they are' 's/spoilt_now = .*;/spoilt_now = rings_and_4;/'
# A group of four rays of which one has no room.
machine rings h9g1t4d128 'the same in wider beats' 's/four_rays_or_2 = .*;/four_rays_or_2 = held[4];/'
# Rays without an answer are not compared with the places of a ring.
machine rings h10g1t4d128 'no ray without a place' 's/full_and_5 = .*;/full_and_5 = 0;/'
machine door t4i1 'a number is in one place' 's/has <= next_has_value/has <= next_has_value | has/'
machine door t4i1q1 'the same, and what a ray asks stays' \
  's/t_1_value_mux = ray_any ? ray_length/t_1_value_mux = ~ray_any ? ray_length/'
machine requests a4h9i1 'all leave once, in order, and stay' 's/there_2 <= waits/there_2 <= waits \& ~there_2/'
machine replies t4g1i1 'one answer a ray, with its tag' 's/tags\[leaving_ray\]/tags[ray_1]/'
machine replies t4g1i1u4 'the same with fewer numbers' 's/tags\[leaving_ray\]/tags[ray_1]/'
machine replies t4g1i1q1u4 'the same, and no count is a miss' 's/counting\[leaving_ray\]/counting[ray_1]/'
# A ray waits for its leaf's word only if two other rays go to leaves meanwhile. So there are four rays.
machine reader a4i2 'a leaf in turn, a ray in one place' "s/settled_1 <= ~writes/settled_1 <= 1'b1/"
machine reader a4i2q1 'the same with a triangle again' 's/goes_on = .*;/goes_on = next_granted;/'
machine reader a4i2e2 'the same with small leaves' "s/settled_1 <= ~writes/settled_1 <= 1'b1/"
machine beats d64i1 'a block a request, in order, whole' 's/askers\[next_oldest_value\]/askers[oldest]/'
machine beats d512i1 'a block a request, in order, its half' 's/askers_word\[2\] ? beat_5/askers_word[1] ? beat_5/'
machine divider 8+0s8i1 'each hit is compared once' 's/wire loads = .*;/wire loads = there \& ~divides;/'
machine best_hits t4c1d4i1 'an answer is the best of its hits' 's/improves = divided_1 & closer_1/improves = divided_1/'
machine best_hits t4c1d4i1q1u4 'the same, or counts and sides' \
  's/side_is_down_xor = .*;/side_is_down_xor = hit_back_1;/'
machine best_hits t4c1d4i1u4 'the same with fewer numbers' 's/improves = divided_1 & closer_1/improves = divided_1/'
machine ties 8+0s8c3i1 'a tie is settled by its moved tests' 's/still = meets_word \& zero_1/still = zero_1/'
machine weights d25e25t4g1i1 'an answer has its best hit' 's/best_det\[ray_wanted\]/best_det[ray]/'
machine registers a4h9i1c34 'each access once, what was written' \
  's/offers_requests <= next_offers_requests_value/offers_requests <= 1/'
damage registers a4h9i1c34 'the high word of a counter' "s/\[33:32\]/[33:32] \& 2'd1/"
machine registers a4h9i1c34k1 'the same with a cache' "s/empties_r <= empties/empties_r <= empties \& ~writes/"
machine registers a4h9i1c34r1 'the same with rings' \
  's/next_offered_r_value = .*;/next_offered_r_value = next_offered_r_value_or_2;/'
machine scene_memory a4i1 'a block a request, as written' "s/free = count == /free = 1'b1 | count == /"
machine epoch e2 'a reset counts once' 's/begins = .*;/begins = resetting;/'
machine read_meter i1c3n3 'a read as long as it took' 's/came <= read_valid/came <= read_valid | came/'
machine pair_feed 8+0/4a4i1 'a record once, with its ray' 's/intervals\[read_id\[0\]\]/intervals[ray_1]/'
machine pair_feed 8+0/4a4i1e2 'the same, and small leaves' 's/intervals\[read_id\[0\]\]/intervals[ray_1]/'
machine triangle_feed 8+0s8i1 'a triangle once, with its ray' \
  's/next_ready_value = there & ~taken/next_ready_value = there/'
machine triangle_feed 8+0s8i1u4 'the same, and fewer numbers' \
  's/next_ready_value = there & ~taken/next_ready_value = there/'
machine triangle_feed 8+0s8c3i1 'the same with a moved ray' 's/along_b = .*;/along_b = tests_word[1];/'
machine serial_triangle 8+0s8i1 'a triangle once, in bounded time' \
  's/compares <= last/compares <= last \& best[0]/'
# A restart that forgets what is done.
machine walker d4a4l4k1i1 'a walk is that of its ray alone' \
  's/trail_2_value_mux = pops ? sum\[3:0\]/& \& {4{~next_some_2_value_eq}}/'
damage walker d4a4l4k1i1 'a child dropped on a full stack' \
  's/wire pushes = pushes_and & walker_eq/& \& ~walks_word[22]/'
damage walker d4a4l4k1i1 'a walk that ends before its last pop' \
  's/value_and_2 = pops & sum\[4\]/value_and_2 = pops \& (sum[4] | next_some_2_value_eq)/'
machine walker d4a4l4k1i1e2s4 'the same, and few steps' 's/trail_2_value_mux = pops ? sum\[3:0\]/& \& {4{~next_some_2_value_eq}}/'
finish_beside machines
