#!/usr/bin/env bash
# Proves the emitted Verilog with yosys and z3: prove.sh EMIT_FORMAL EMIT_LEMMAS FOLDER [short | DESIGN FORMAT [N]]
# With a design and a format, it proves that unit alone; an empty format is the design's default. With N, the unit takes
# a test every N cycles.
# Prints a table of proof, width, result, seconds; false when anything was not proved. docs/formal.md explains.
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/proofs.sh"
emit_formal=$(realpath "$1")
emit_lemmas=$(realpath "$2")
mkdir -p "$3"
work=$(realpath "$3")
short=$([[ ${4:-} == short ]] && echo short)
failed=0
declare -A seen  # components, by their text

report() {
  printf '%-44s %-9s %-10s %6s\n' "$@"
}

# row PROOF WIDTH EXPECTED COMMAND...: EXPECTED is what the table says when all is well.
row() {
  local proof=$1 width=$2 expected=$3 began=$EPOCHREALTIME result=proved
  shift 3
  "$@" || result='NOT PROVED'
  [[ $expected == damaged ]] && { [[ $result == proved ]] && result='NOT FOUND' || result=found; }
  [[ $result == NOT* ]] && failed=1
  report "$proof" "$width" "$result" "$(awk -v a="$began" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')"
}

lemmas() {
  "$emit_lemmas" "$@" >"$work/lemma_$1${2:-}.smt2" && prove_lemmas "$work/lemma_$1${2:-}.smt2"
}

# enter DESIGN FORMAT [stall|none [N]]: goes to a folder with all that the proofs read. With none, the design has no flow
# control. It takes a test every N cycles.
enter() {
  local folder=$work/$1-${2/\//_}-${3:-stall}-${4:-1}
  rm -rf "$folder"
  "$emit_formal" "$1" "$2" "$folder" "${3:-stall}" "${4:-1}" && cd "$folder" || exit 1
}

finish() {
  printf '%s in %s s\n' "$([[ $failed == 0 ]] && echo 'all proved' || echo 'NOT all proved')" "$SECONDS"
  exit $failed
}

# all_of DESIGN FORMAT: what together says that the pipeline equals its combinational form.
all_of() {
  enter "$1" "$2"
  row "$1: stands still when it must" "$2" proved prove_hold "$1"
  row "$1: valid, ready, tags" "$2" proved prove_control "$1"
  row "$1: HIT and tag of its operands" "$2" proved prove_flow "$1"
  components_of "$1" "$2"
}

# One that is the same as in an earlier design is proved there.
components_of() {
  local module key
  while read -r module _; do
    key=$(awk -v m="$module" '$1 == "module" { on = index($2, m) == 1 } on' design.v | cat - "$module.v" | sha256sum)
    [[ -n ${seen[$key]:-} ]] && continue
    seen[$key]=1
    row "  ${module#"$1"_}" "$2" proved prove_component "$1" "$module"
  done <components
}

# all_without_flow_control DESIGN FORMAT: the same proofs for the design that never waits, and its result FIFO.
all_without_flow_control() {
  enter "$1" "$2" none
  row "$1, no flow control: valid, tags" "$2" proved prove_control "$1"
  row "$1, no flow control: HIT and tag" "$2" proved prove_flow "$1"
  row "$1, no flow control: its FIFO loses nothing" "$2" proved prove_fifo "$1"
  components_of "$1" "$2"
}

# all_every N DESIGN FORMAT: the same proofs for the design that takes a test every N cycles, with and without flow
# control.
all_every() {
  local interval=$1 flow
  shift
  for flow in stall none; do
    enter "$1" "$2" $flow "$interval"
    local said="$1 every $interval cycles"
    [[ $flow == stall ]] || said="  no flow control"
    [[ $flow == none ]] || row "$said: stands still" "$2" proved prove_hold "$1"
    row "$said: valid, tags, phase" "$2" proved prove_control "$1"
    row "$said: HIT and tag" "$2" proved prove_flow "$1"
    [[ $flow == stall ]] || row "$said: its FIFO loses nothing" "$2" proved prove_fifo "$1"
    components_of "$1" "$2"
  done
}

# damage DESIGN FORMAT WHAT SED PROOF...: the proof must fail of a copy that sed has changed, by a
# counterexample. The copy is of design.v, or of $file. With $flow none, the design has no flow control; with $every N, it takes a
# test every N cycles.
damage() {
  local name=$1 format=$2 what=$3 sed=$4 verilog=${file:-design.v}
  shift 4
  enter "$name" "$format" "${flow:-stall}" "${every:-1}"
  sed "$sed" "$verilog" >damaged.v
  cmp -s "$verilog" damaged.v && { echo "no damage done: $what" >&2; failed=1; return; }
  mv damaged.v "$verilog"
  row "damage: $what" "$format" damaged refuted_not "$@"
}

# True unless the proof ends with a counterexample.
refuted_not() {
  "$@" && return
  ! grep -qE 'Status: FAILED' ./*.log && [[ $(hold_answers) != 'sat sat ' ]]
}

if [[ -n ${4:-} && -z $short ]]; then
  bits=$(enter "$4" "${5:-}" stall "${6:-1}" && cat format) || exit 1
  report proof width result seconds
  if [[ -n ${6:-} ]]; then
    all_every "$6" "$4" "$bits"
  else
    all_of "$4" "$bits"
    all_without_flow_control "$4" "$bits"
  fi
  finish
fi
report proof width result seconds
row 'trimming keeps order and sign; kept bits' 'n 6..32' proved lemmas trimming
row 'a product has 2n-1 bits' 'n 6..32' proved lemmas products
row 'a product is the sum of its pieces' 'n 6..32' proved lemmas pieces
row 'a product without the zeros of an operand' 'k 1..63' proved lemmas shifts
row 'saturating shift, and products of it' 'n+g 6..35' proved lemmas saturation
row 'EBND is a bound' 'n 6..32' proved lemmas bound
row 'EBND by all edges, and it is attained' 'n = 4' proved lemmas attained 4
if [[ -z $short ]]; then
  row 'EBND by all edges, and it is attained' 'n = 5' proved lemmas attained 5
  for format in 24/24 20/24 32/63; do
    for name in int_slabs int_plucker; do all_of "$name" "$format"; done
  done
  for name in int_major int_major_pair; do all_of "$name" 20+1/13; done
  for name in fp_slabs fp_plucker; do all_of "$name" fp32; done
  for format in e8m23 e8m15 e5m10; do all_of fp_slabs_safe "$format"; done
  for name in int_slabs int_plucker; do all_without_flow_control "$name" 20/24; done
  for name in int_major int_major_pair; do all_without_flow_control "$name" 20+1/13; done
  for name in fp_slabs fp_plucker; do all_without_flow_control "$name" fp32; done
  all_without_flow_control fp_slabs_safe e5m10
  for interval in 2 3; do
    for name in int_slabs int_plucker; do all_every $interval "$name" 20/24; done
    for name in int_major int_major_pair; do all_every $interval "$name" 20+1/13; done
    for name in fp_slabs fp_plucker fp_plucker_direct; do all_every $interval "$name" fp32; done
    all_every $interval fp_slabs_safe e5m10
  done
  enter int_slabs 6/6
  row 'int_slabs: standing still twice, wherever' 6/6 proved prove_stalled int_slabs
  enter int_slabs 6/6 stall 2
  row '  every 2 cycles' 6/6 proved prove_stalled int_slabs
  enter int_slabs 6/11
  row '  mul_6x6s_to_10_0, bit for bit' 6/11 proved prove_bits int_slabs int_slabs_mul_6x6s_to_10_0
else
  all_of int_slabs 20/24
  all_without_flow_control int_slabs 20/24
  all_every 2 int_slabs 6/6
fi
damage int_slabs 20/24 'a register less' 's/irlen_s2 <= irlen_s1/irlen_s2 <= irlen_s0/' prove_flow
damage int_slabs 20/24 'swapped operands' 's/izmin_s0 - irz_s0/irz_s0 - izmin_s0/' prove_flow
damage int_slabs 20/24 'a component ignores its enable' '0,/if (en)/s//if (1)/' prove_hold int_slabs
damage int_slabs 20/24 'input latches ignore theirs' 's/\(irx_s0\) <= irx;/\1 <= irx; end if (1) begin/' prove_hold int_slabs
damage int_slabs 20/24 'valid bits ignore theirs' 's/else if (advance) valid/else valid/' prove_control int_slabs
damage int_slabs 20/24 'a tag overtakes' 's/tag_s2 <= tag_s1/tag_s2 <= tag_s0/' prove_control int_slabs
damage int_slabs 20/24 'a product of other pieces' 's/ + piece_1_s1/ - piece_1_s1/' \
  prove_component int_slabs int_slabs_mul_20x20s_to_38_15
flow=none damage int_slabs 20/24 'without flow control, a register less' 's/irlen_s2 <= irlen_s1/irlen_s2 <= irlen_s0/' prove_flow
flow=none damage int_slabs 20/24 'a valid bit too early' 's/{valid\[3:0\], in_valid}/{valid[3:1], in_valid, in_valid}/' prove_control int_slabs
flow=none file=fifo.v damage int_slabs 20/24 'a credit too many' "s/used != 3'd6/used != 3'd7/" prove_fifo int_slabs
flow=none file=fifo.v damage int_slabs 20/24 'a credit too few' "s/used != 3'd6/used != 3'd5/" prove_fifo int_slabs
flow=none file=fifo.v damage int_slabs 20/24 'the newest result overtakes' 's/held\[oldest\[2:0\]\]/held[0]/' prove_fifo int_slabs
flow=none file=fifo.v damage int_slabs 20/24 'a result is lost' 's/if (arrives) held/if (arrives \& ~taken) held/' prove_fifo int_slabs
flow=none every=3 file=fifo.v damage int_slabs 6/6 'every 3 cycles, a credit too many' "s/used != 3'd4/used != 3'd5/" \
  prove_fifo int_slabs
flow=none every=3 file=fifo.v damage int_slabs 6/6 'every 3 cycles, a credit too few' "s/used != 3'd4/used != 3'd3/" \
  prove_fifo int_slabs
every=2 damage int_slabs 6/6 'a phase counter that stands still' "s/phase + 1'd1/phase/" prove_control int_slabs
every=2 damage int_slabs 6/6 'swapped operand multiplexer' "s/1'd1: begin/1'd0: begin/;s/default: begin/1'd1: begin/" prove_flow
if [[ -z $short ]]; then
  for flow in stall none; do
    every=3 damage int_slabs 6/6 'a phase too few' "s/phase == 2'd2/phase == 2'd1/" prove_control int_slabs
    every=3 damage int_slabs 6/6 'the phase survives a reset' "s/if (rst) phase <= 2'd0/if (1'b0) phase <= 2'd0/" \
      prove_control int_slabs
    every=3 damage int_slabs 6/6 'an operation in another phase' "s/2'd2: begin/2'd3: begin/" prove_flow
  done
  flow=
  every=3 damage int_slabs 6/6 'the phase goes on in a stall' 's/else if (advance) phase/else phase/' \
    prove_control int_slabs
  every=3 damage int_slabs 6/6 'the phase goes on in a stall' 's/else if (advance) phase/else phase/' prove_hold int_slabs
  damage fp_slabs fp32 'a stage less in an operator' 's/larger_s3 <= larger_s2;/larger_s3 <= larger_s1;/' \
    prove_component fp_slabs fp_slabs_fp_subtract_8_23
fi
finish
