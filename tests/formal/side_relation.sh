#!/usr/bin/env bash
# For all binary32 q and p: q - p, rounded to nearest, is below 0 exactly when q < p. So fp_plucker_direct answers as
# fp_plucker does. The same claim with <= must be refuted: then a proof that cannot fail would show.
set -euo pipefail

refuted() {  # COMPARISON: z3's answer to "is there a pair for which the claim is wrong"
  z3 -in -T:120 <<END
(set-logic QF_FP)
(declare-const q (_ FloatingPoint 8 24))
(declare-const p (_ FloatingPoint 8 24))
(assert (not (= (fp.lt (fp.sub RNE q p) (_ +zero 8 24)) ($1 q p))))
(check-sat)
END
}

less=$(refuted fp.lt)
less_or_equal=$(refuted fp.leq)
echo "a pair that refutes q < p: $less; one that refutes q <= p: $less_or_equal"
[ "$less" = unsat ] && [ "$less_or_equal" = sat ]
