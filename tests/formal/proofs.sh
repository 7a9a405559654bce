# shellcheck shell=bash
# The proofs of one design, each a function that leaves its solver's output in NAME.log and is true when
# everything was proved and every cover reached. They run in a folder that emit_formal wrote.
formal=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# beside COMMAND...: runs it in a folder of its own, beside as many others as there are processors, or JOBS. What they
# print is shown in the order of the calls. One that is false, or that gives no answer, sets `failed`. A solver may take
# 20 minutes of processor time, which does not depend on what else runs.
failed=0
begun=0
shown=0
beside() {
  local folder=row_$((++begun))
  while (($(jobs -pr | wc -l) >= ${JOBS:-$(nproc)})); do wait -n; done
  show
  mkdir "$folder"
  set -m  # A process group each, so that `stop` ends its solver too.
  (cd "$folder" && ulimit -t 1200 && { "$@" >table; echo $? >code; mv code answer; }) </dev/null &
  set +m
}
show() {
  while [[ -f row_$((shown + 1))/answer ]]; do
    cat "row_$((++shown))/table"
    [[ $(<"row_$shown/answer") == 0 ]] || failed=1
  done
}
# finish_beside NAME: waits for all that `beside` has begun, and exits. With PROVE=all or PROVE=new it keeps what was proved.
finish_beside() {
  while wait -n; [[ -n $(jobs -pr) ]]; do show; done
  show
  ((shown == begun)) || { echo "no answer in row_$((shown + 1))" >&2; failed=1; }
  [[ -z ${PROVE:-} ]] || keep_proved "$1"
  exit $failed
}
# known WORD... FILE...: whether the words and the files' text, without comments, are of a row of proved.txt: so nothing that
# it was proved of has changed. Never with PROVE=all. In any case the row's folder keeps the hash.
known() {
  local word
  for word in "$@"; do
    if [[ -f $word ]]; then sed 's|//.*||' "$word"; else echo "$word"; fi
  done | sha256sum | cut -d' ' -f1 >key
  [[ ${PROVE:-} != all ]] && grep -q "^$(<key) " "$formal/proved.txt"
}
# Puts the rows of the table NAME that were proved now into proved.txt, in place of all that it has of them.
keep_proved() {
  local name=$1 i kept
  ((failed == 0)) || return
  kept=$(for ((i = 1; i <= begun; ++i)); do
    printf '%s %s: %s\n' "$(<"row_$i/key")" "$name" "$(sed -E 's/ +(proved|found|reached|known) .*//; s/ +/ /g' "row_$i/table")"
  done)
  { grep -v "^[0-9a-f]* $name: " "$formal/proved.txt"; echo "$kept"; } | LC_ALL=C sort -k2 >proved && cp proved "$formal/proved.txt"
}

stop() {
  local group
  for group in $(jobs -pr); do kill -- "-$group"; done
  exit 1
}
trap stop HUP INT TERM

# smtbmc NAME STEPS OPTION...: the assertions hold, under assumptions that can be met, and the covers are met.
smtbmc() {
  local name=$1 steps=$2
  shift 2
  yosys-smtbmc --noprogress --presat -s z3 "$@" -t "$steps" "$name.smt2" >>"$name.log" 2>&1 &&
    grep -q 'Status: PASSED' "$name.log" && covers "$name" "$steps" "$@"
}

covers() {
  local name=$1 steps=$2
  shift 2
  yosys-smtbmc --noprogress -c -s z3 "$@" -t "$steps" "$name.smt2" >"$name.cover.log" 2>&1 &&
    grep -q 'Reached cover' "$name.cover.log"
}

# to_smt2 NAME: runs the yosys script on standard input, which names NAME.raw.smt2, and declares the symbols.
to_smt2() {
  cat >"$1.ys"
  yosys -q "$1.ys" >"$1.log" 2>&1 && cat symbols.smt2 "$1.raw.smt2" >"$1.smt2"
}

# Modules that models.v has in a simpler form.
modelled() {
  sed -n 's/^module \([a-z0-9_]*\) .*/\1/p' models.v | tr '\n' ' '
}

symbolic=(--unroll --noincr --logic QF_UFBV)

# with_models NAME: the module NAME of NAME.v around the design, its components replaced.
with_models() {
  to_smt2 "$1" <<END
read_verilog -formal design.v reference.v
delete $(modelled)
read_verilog -formal models.v symbols.v $1.v
hierarchy -smtcheck -top $1
proc
techmap -map $formal/multiply.v
hierarchy -smtcheck -top $1
flatten
opt_clean
check -assert
write_smt2 -wires $1.raw.smt2
END
}

prove_flow() {
  with_models flow && smtbmc flow $(($(cat latency) + 2)) "${symbolic[@]}"
}

# Two cycles of standing still, wherever.
prove_stalled() {
  with_models stalled && smtbmc stalled $(($(cat latency) + 4)) "${symbolic[@]}"
}

# As many as a component has edges, and the first.
steps_of() {
  awk -v m="$1" '$1 == m { print $2 + 1 }' components
}

# prove_component DESIGN MODULE: whole insides; products alone are symbols.
prove_component() {
  local module=$2
  to_smt2 "$module" <<END && smtbmc "$module" "$(steps_of "$module")" "${symbolic[@]}"
read_verilog -formal -DPRODUCTS_ARE_SYMBOLS design.v $module.v symbols.v
hierarchy -smtcheck -top flow
proc
techmap -map $formal/multiply.v
hierarchy -smtcheck -top flow
flatten
opt_clean
check -assert
write_smt2 -wires $module.raw.smt2
END
}

# The same with the products as they are.
prove_bits() {
  local module=$2
  to_smt2 "$module.bits" <<END && smtbmc "$module.bits" "$(steps_of "$module")" "${symbolic[@]}"
read_verilog -formal design.v $module.v
hierarchy -check -top flow
proc
flatten
opt_clean
check -assert
write_smt2 -wires $module.bits.raw.smt2
END
}

# Components play no part in valid bits and tags.
prove_control() {
  awk '/^endmodule/ && !done { while ((getline line < "control.v") > 0) print line; done = 1 } { print }' design.v \
    >control_design.v
  to_smt2 control <<END || return
read_verilog -formal control_design.v
hierarchy -check -top $1
delete t:$1_*
hierarchy -check -top $1
delete -output $(cat results)
proc
opt_clean -purge
write_smt2 -wires control.raw.smt2
END
  yosys-smtbmc --noprogress -s z3 "${symbolic[@]}" -i -t 3 control.smt2 >>control.log 2>&1 &&
    yosys-smtbmc --noprogress -s z3 "${symbolic[@]}" -t 3 control.smt2 >>control.log 2>&1 &&
    covers control $(($(cat latency) + 4)) "${symbolic[@]}"
}

# The result FIFO around a stand-in for a unit without flow control. It has no symbols.
prove_fifo() {
  to_smt2 fifo <<END || return
read_verilog -formal fifo.v
hierarchy -check -top $1_fifo
proc
flatten
opt_clean
check -assert
write_smt2 -wires fifo.raw.smt2
END
  mv fifo.raw.smt2 fifo.smt2
  local bits=(--unroll --noincr --logic QF_BV)
  yosys-smtbmc --noprogress -s z3 "${bits[@]}" -i -t 2 fifo.smt2 >>fifo.log 2>&1 &&
    yosys-smtbmc --noprogress -s z3 "${bits[@]}" -t 2 fifo.smt2 >>fifo.log 2>&1 &&
    covers fifo $((($(cat latency) + $(cat interval)) * 2 + 8)) "${bits[@]}"
}

# One step of the whole design in which a result waits and rst is low, its arithmetic cut out: no register of it or of
# its components changes.
prove_hold() {
  to_smt2 hold <<END || return
read_verilog design.v
hierarchy -check -top $1
proc
flatten
opt_clean
opt_dff
cutpoint t:\$mux t:\$xor t:\$mul t:\$add t:\$sub t:\$lt t:\$eq t:\$ne t:\$reduce_* t:\$logic_*
dffunmap
write_smt2 -wires hold.raw.smt2
END
  awk -v d="$1" '
    { print }
    $2 == "yosys-smt2-register" { same[++n] = $3 }
    END {
      print "(declare-const now |" d "_s|) (declare-const next |" d "_s|)"
      print "(assert (|" d "_h| now)) (assert (|" d "_h| next)) (assert (|" d "_t| now next))"
      print "(assert (|" d "_n out_valid| now)) (assert (not (|" d "_n out_ready| now)))"
      print "(assert (not (|" d "_n rst| now)))"
      print "(check-sat)\n(assert (not (and"
      for (i = 1; i <= n; ++i) print "(= (|" d "_n " same[i] "| now) (|" d "_n " same[i] "| next))"
      print ")))\n(check-sat)\n(echo \"" n " registers\")"
    }' hold.raw.smt2 >hold.smt2
  z3 hold.smt2 >>hold.log 2>&1
  [[ $(hold_answers) == 'sat unsat ' ]]
}

# What z3 said of the step, and of a register that changes in it.
hold_answers() {
  [[ -f hold.log ]] && tail -n 3 hold.log | head -n 2 | tr '\n' ' '
}

# prove_lemmas FILE: every answer is there and is the one that the script announces.
prove_lemmas() {
  z3 -smt2 "$1" >"$1.log" 2>&1
  awk -v asked="$(grep -c '^(check-sat' "$1")" '
    / : (sat|unsat)$/ { expected = $NF; next }
    { ++n; if ($0 != expected) bad = 1; expected = "" }
    END { exit bad || n == 0 || n != asked }' "$1.log"
}
