# shellcheck shell=bash
# The proofs of one design, each a function that leaves its solver's output in NAME.log and is true when
# everything was proved and every cover reached. They run in a folder that emit_formal wrote.
formal=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

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

# A memory of rays before the unit, whose stand-in shows what it is given.
prove_slots() {
  to_smt2 slots <<END || return
read_verilog -formal slots.v
hierarchy -check -top $1_slots
proc
flatten
memory -nordff
opt_clean
check -assert
write_smt2 -wires slots.raw.smt2
END
  yosys-smtbmc --noprogress -s z3 "${symbolic[@]}" -i -t 2 slots.smt2 >>slots.log 2>&1 &&
    yosys-smtbmc --noprogress -s z3 "${symbolic[@]}" -t 2 slots.smt2 >>slots.log 2>&1 && covers slots 4 "${symbolic[@]}"
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
