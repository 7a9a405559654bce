#!/usr/bin/env bash
# What `make prove DESIGN=x BITS=y` runs: one small unit is proved, a damaged one is not, and an unknown design or
# format is one line: prove_one.sh EMIT_FORMAL EMIT_LEMMAS FOLDER
set -uo pipefail
prove=$(dirname "${BASH_SOURCE[0]}")/prove.sh
emit_formal=$(realpath "$1")
emit_lemmas=$(realpath "$2")
mkdir -p "$3"
work=$(realpath "$3")

fail() {
  echo "prove_one: $*" >&2
  exit 1
}

"$prove" "$emit_formal" "$emit_lemmas" "$work/whole" int_slabs 6/6 | tee "$work/table" || fail 'int_slabs 6/6 is not proved'
for proof in 'stands still' 'HIT and tag of its' 'no flow control: HIT' 'its FIFO' 'mul_6x6s'; do
  grep -q "$proof.* proved " "$work/table" || fail "the table has no proved row of: $proof"
done

# The same Verilog but for one register.
cat >"$work/damaging" <<END
#!/usr/bin/env bash
"$emit_formal" "\$@" && sed -i 's/irlen_s2 <= irlen_s1/irlen_s2 <= irlen_s0/' "\$3/design.v"
END
chmod +x "$work/damaging"
"$prove" "$work/damaging" "$emit_lemmas" "$work/damaged" int_slabs 6/6 >"$work/table" && fail 'damage is not found'
grep -q 'HIT and tag of its operands .*NOT PROVED' "$work/table" || fail 'a proof failed that is not about the results'

# refused LINE-PART ARGUMENT...
refused() {
  local part=$1 said
  shift
  said=$("$prove" "$emit_formal" "$emit_lemmas" "$work/refused" "$@" 2>&1) && fail "accepted: $*"
  [[ $(wc -l <<<"$said") == 1 && $said == *"$part"* ]] || fail "of $* it says: $said"
}
refused 'no_such_design' no_such_design 6/6
refused '6/x' int_slabs 6/x
refused 'x: not an interval' int_slabs 6/6 x
refused '65' int_slabs 6/6 65
