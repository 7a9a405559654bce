#!/usr/bin/env bash
# Proves fitted designs with yosys and z3: prove_fitted.sh EMIT_FITTED EMIT_FORMAL HITPIPE FOLDER [short]
# For all operands that meet the demands the fitted design's HIT is the unfitted one's; the fitted pipeline is
# proved as an unfitted one is. So are the units that `HITPIPE fit` writes, by their own manifest and Verilog.
# Prints a table of proof, result, seconds; false when anything was not proved.
set -uo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/proofs.sh"
emit_fitted=$(realpath "$1")
emit_formal=$(realpath "$2")
hitpipe=$(realpath "$3")
mkdir -p "$4"
work=$(realpath "$4")
short=${5:-}
failed=0

# row PROOF EXPECTED COMMAND...: EXPECTED is what the table says when all is well.
row() {
  local proof=$1 expected=$2 began=$EPOCHREALTIME result=proved
  shift 2
  "$@" || result='NOT PROVED'
  [[ $expected == damaged ]] && { [[ $result == proved ]] && result='NOT FOUND' || result=found; }
  [[ $result == NOT* ]] && failed=1
  printf '%-62s %-10s %6s\n' "$proof" "$result" \
    "$(awk -v a="$began" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')"
}

# Modules that models.v has in a simpler form are deleted; an empty `delete` would delete all.
prove_fits() {
  to_smt2 fits <<END && smtbmc fits 1 "${symbolic[@]}"
read_verilog -formal plain.v kept.v fitted.v demands.v
$([[ -s models.v ]] && echo "delete $(modelled)")
read_verilog -formal models.v symbols.v fits.v
hierarchy -smtcheck -top fits
proc
techmap -map $formal/multiply.v
hierarchy -smtcheck -top fits
flatten
opt_clean
check -assert
write_smt2 -wires fits.raw.smt2
END
}

# What fits.v assumes of float operators, of their own logic.
prove_operators() {
  to_smt2 lemmas <<END && smtbmc lemmas 1 "${symbolic[@]}"
read_verilog -formal plain.v kept.v lemmas.v
hierarchy -check -top lemmas
proc
flatten
opt_clean
check -assert
write_smt2 -wires lemmas.raw.smt2
END
}

# work_folder DESIGN FORMAT SET: SET is a number or a manifest.
work_folder() {
  local set=${3#"$work/"}
  echo "$work/$1-${2/\//_}-${set//\//-}"
}

# folder DESIGN FORMAT SET: with all that prove_fits reads; prints its name.
folder() {
  local made
  made=$(work_folder "$@")
  rm -rf "$made"
  "$emit_fitted" "$1" "$2" "$3" "$made" && echo "$made"
}

fits() {
  cd "$(folder "$1" "$2" "$3")" || exit 1
  local set
  set=$(<set)
  row "$1 $2, $set: the unfitted HIT" proved prove_fits
  [[ ! -s lemmas.v ]] || row "  float operators' results" proved prove_operators
}

# pipeline DESIGN FORMAT SET: the fitted pipeline equals its own combinational form; a manifest's is the one beside
# it.
pipeline() {
  local made module
  made=$(work_folder "$@")-pipeline
  rm -rf "$made"
  "$emit_formal" "$1" "$2" "$made" "$3" || exit 1
  cd "$made" || exit 1
  [[ $3 != *.json ]] || cp "${3%.json}.v" design.v
  row "  pipeline: stands still when it must" proved prove_hold "$1"
  row "  pipeline: valid, ready, tags" proved prove_control "$1"
  row "  pipeline: HIT and tag of its operands" proved prove_flow "$1"
  while read -r module _; do
    [[ $module == *_fp_* && $module != *_cut* ]] && continue  # the unfitted design's own, proved there
    row "  ${module#"$1"_}" proved prove_component "$1" "$module"
  done <components
}

# fitted_to SCENE: what `hitpipe fit` makes of each design; the scene must ask less than all of each.
fitted_to() {
  local name manifest bits
  echo "hitpipe fit --scene $1 --no-shadows --width 32 --height 32"
  "$hitpipe" fit --scene "$1" --no-shadows --width 32 --height 32 --out "$work/$1" >"$work/$1.log" 2>&1 ||
    { echo "not fitted to $1: see $work/$1.log" >&2; failed=1; return; }
  for name in int_slabs int_plucker fp_slabs fp_plucker; do
    manifest=$work/$1/$name/$name.json
    bits=$(sed -n 's/^  "bits": "\(.*\)",$/\1/p' "$manifest")
    fits "$name" "$bits" "$manifest"
    pipeline "$name" "$bits" "$manifest"
  done
}

# damage DESIGN FORMAT SET FILE WHAT SED: the proof must end with a counterexample when sed has changed a file.
damage() {
  cd "$(folder "$1" "$2" "$3")" || exit 1
  sed "$6" "$4" >damaged
  cmp -s "$4" damaged && { echo "no damage done: $5" >&2; failed=1; return; }
  mv damaged "$4"
  row "damage: $5" damaged refuted_not
}

# True unless the proof ends with a counterexample.
refuted_not() {
  prove_fits && return
  ! grep -q 'Status: FAILED' fits.log
}

coarse=5
all=8
all_of_safe_floats=7
if [[ -n $short ]]; then
  fits int_slabs 20/24 $all
  fits fp_slabs_safe e5m10 $all_of_safe_floats
else
  for ((set = 0; set <= all_of_safe_floats; ++set)); do
    for format in e8m15 e5m10; do fits fp_slabs_safe "$format" "$set"; done
  done
  pipeline fp_slabs_safe e5m10 $all_of_safe_floats
  for ((set = 0; set < all; ++set)); do
    for name in int_slabs int_plucker; do fits "$name" 24/24 "$set"; done
    for name in fp_slabs fp_plucker; do fits "$name" fp32 "$set"; done
  done
  for name in int_slabs int_plucker; do fits "$name" 24/24 $all; fits "$name" 20/24 $all; pipeline "$name" 20/24 $all; done
  for name in fp_slabs fp_plucker; do fits "$name" fp32 $all; pipeline "$name" fp32 $all; done
  for scene in spheres branch; do fitted_to $scene; done
fi
damage int_slabs 20/24 $all demands.v 'demands not assumed' "s/assign error = /assign error = 1'b0 \&\& /;s/^    ||/    \&\&/"
damage int_slabs 20/24 $coarse demands.v 'low zeros not assumed' "s/|iymin\[2:0\]/1'b0/"
damage int_slabs 20/24 $all fitted.v 'a difference the other way round' 's/= ixmax - /= ~ixmax - /'
printf '%s in %s s\n' "$([[ $failed == 0 ]] && echo 'all proved' || echo 'NOT all proved')" "$SECONDS"
exit $failed
