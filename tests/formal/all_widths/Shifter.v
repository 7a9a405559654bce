(* The shifter of hls/num/saturating_shift.hpp computes x 2^e, clamped to the word, in every width. *)
From Coq Require Import ZArith Lia Bool.
From HitpipeMajor Require Import Numbers Words.
Open Scope Z_scope.

(* The or of 2^levels bits. *)
Fixpoint or_of (levels : nat) (bits : Z) : Z :=
  match levels with
  | O => bits
  | S fewer =>
      let half := 2 ^ Z.of_nat fewer in
      or_of fewer (Z.lor (slice bits (2 * half - 1) half) (slice bits (half - 1) 0))
  end.

(* The low bits of x, with `fill` shifted in below them. *)
Definition shifted_in (bits fill x amount : Z) : Z :=
  cat amount (slice x (bits - 1 - amount) 0) (slice fill (amount - 1) 0).

Record Shifted := { magnitude : Z; lost : Z }.

(* One level: left by 2^power if bit `power` of e is 1. *)
Definition shift_level (bits magnitude fill e : Z) (power : nat) : Shifted :=
  let amount := 2 ^ Z.of_nat power in
  let shift := slice e (Z.of_nat power) (Z.of_nat power) in
  let moved := if amount <? bits then shifted_in bits fill magnitude amount else fill in
  let lost := or_of power (slice magnitude (bits - 1) (bits - amount)) in
  {| magnitude := if shift =? 1 then moved else magnitude; lost := Z.land shift lost |}.

(* The levels below `power`, from the greatest to 0. *)
Fixpoint shift_levels (bits fill e : Z) (power : nat) (from : Shifted) : Shifted :=
  match power with
  | O => from
  | S next =>
      let to := shift_level bits (magnitude from) fill e next in
      shift_levels bits fill e next {| magnitude := magnitude to; lost := Z.lor (lost from) (lost to) |}
  end.

(* The bits needed to count 0 .. values - 1. *)
Definition count_bits (values : Z) : nat := Z.to_nat (Z.log2_up values).

Definition saturating_shift (width x e : Z) : Z :=
  let bits := width - 1 in
  let levels := count_bits width in
  let fill := spread (sign width x) bits in
  let first := shift_level bits (Z.lxor (slice x (bits - 1) 0) fill) fill e (levels - 1) in
  let shifted := shift_levels bits fill e (levels - 1) first in
  as_signed width
    (cat bits (Z.b2z (sign width x))
       (Z.lxor (Z.lor (magnitude shifted) (spread (lost shifted =? 1) bits)) fill)).

(* ---- Proof ---- *)

Lemma or_of_is levels bits :
  is_unsigned (2 ^ Z.of_nat levels) bits -> or_of levels bits = Z.b2z (negb (bits =? 0)).
Proof.
  revert bits. induction levels as [| levels IH]; intros bits H.
  - cbn [or_of]. change (2 ^ Z.of_nat 0) with 1 in H. unfold is_unsigned in H. change (2 ^ 1) with 2 in H.
    assert (bits = 0 \/ bits = 1) as [-> | ->] by lia; reflexivity.
  - cbn [or_of]. rewrite Nat2Z.inj_succ, Z.pow_succ_r in H by lia.
    set (half := 2 ^ Z.of_nat levels) in *.
    assert (0 < half) as HalfPositive by (apply power_positive; lia).
    unfold slice. replace (2 * half - 1 - half + 1) with half by lia.
    replace (half - 1 - 0 + 1) with half by lia. rewrite Z.pow_0_r, Z.div_1_r.
    pose proof (power_positive half ltac:(lia)) as Power.
    rewrite IH.
    + unfold is_unsigned in H. replace (2 * half) with (half + half) in H by lia.
      rewrite power_sum in H by lia.
      rewrite (Z.mod_small (bits / 2 ^ half)).
      2: { split; [apply Z.div_pos; lia | apply Z.div_lt_upper_bound; lia]. }
      f_equal. f_equal. pose proof (Z.div_mod bits (2 ^ half) ltac:(lia)) as Division.
      destruct (Z.eqb_spec (Z.lor (bits / 2 ^ half) (bits mod 2 ^ half)) 0) as [Zero | NotZero].
      * apply Z.lor_eq_0_iff in Zero. destruct Zero as [Z1 Z2]. rewrite Z1, Z2 in Division. symmetry.
        apply Z.eqb_eq. lia.
      * symmetry. apply Z.eqb_neq. intros ->. apply NotZero.
        rewrite Z.div_0_l, Z.mod_0_l by lia. reflexivity.
    + apply or_small; apply Z.mod_pos_bound; exact Power.
Qed.

(* In one's complement c is the bit that is shifted in: 1 for a negative word, else 0. *)
Section Levels.
Variables (bits e y : Z) (negative : bool).
Hypothesis (BitsPositive : 1 <= bits) (ExponentPositive : 0 <= e).
Let c := Z.b2z negative.
Let fill := spread negative bits.

Lemma fill_is : fill = c * (2 ^ bits - 1).
Proof. apply spread_is. Qed.

Lemma bit_is : c = 0 \/ c = 1.
Proof. unfold c. destruct negative; auto. Qed.

(* One level that shifts: every lost 1 means that the result does not fit. *)
Lemma level_shifts v power :
  is_unsigned bits v -> 2 ^ Z.of_nat power <= bits -> slice e (Z.of_nat power) (Z.of_nat power) = 1 ->
  let to := shift_level bits v fill e power in
  is_unsigned bits (magnitude to) /\
  (lost to = 0 /\ magnitude to + c = (v + c) * 2 ^ (2 ^ Z.of_nat power) \/
   lost to = 1 /\ 2 ^ bits - 1 + c < (v + c) * 2 ^ (2 ^ Z.of_nat power)).
Proof.
  intros Hv Amount Shift. unfold shift_level. rewrite Shift. cbn [magnitude lost].
  change (1 =? 1) with true. cbv iota. set (amount := 2 ^ Z.of_nat power) in *.
  assert (0 < amount) as AmountPositive by (apply power_positive; lia).
  set (high := v / 2 ^ (bits - amount)). set (low := v mod 2 ^ (bits - amount)).
  pose proof (power_positive (bits - amount) ltac:(lia)) as PowerRest.
  pose proof (power_positive amount ltac:(lia)) as PowerAmount.
  assert (2 ^ bits = 2 ^ (bits - amount) * 2 ^ amount) as Split.
  { rewrite <- power_sum by lia. f_equal. lia. }
  pose proof (Z.div_mod v (2 ^ (bits - amount)) ltac:(lia)) as Division. fold high low in Division.
  pose proof (Z.mod_pos_bound v (2 ^ (bits - amount)) PowerRest) as LowRange. fold low in LowRange.
  unfold is_unsigned in *.
  assert (0 <= high < 2 ^ amount) as HighRange.
  { split; [apply Z.div_pos; lia | apply Z.div_lt_upper_bound; lia]. }
  assert (slice v (bits - 1) (bits - amount) = high) as ->.
  { unfold slice. fold high. replace (bits - 1 - (bits - amount) + 1) with amount by lia.
    apply Z.mod_small. exact HighRange. }
  assert ((if amount <? bits then shifted_in bits fill v amount else fill) =
          low * 2 ^ amount + c * (2 ^ amount - 1)) as ->.
  { destruct (Z.ltb_spec amount bits) as [Less | Same].
    - unfold shifted_in, cat, slice. rewrite Z.pow_0_r, !Z.div_1_r.
      replace (bits - 1 - amount - 0 + 1) with (bits - amount) by lia. fold low.
      replace (amount - 1 - 0 + 1) with amount by lia. f_equal. rewrite fill_is.
      destruct bit_is as [-> | ->]; [apply Z.mod_0_l; lia |]. rewrite !Z.mul_1_l, Split.
      replace (2 ^ (bits - amount) * 2 ^ amount - 1) with
        (2 ^ amount - 1 + (2 ^ (bits - amount) - 1) * 2 ^ amount) by ring.
      rewrite Z_mod_plus_full. apply Z.mod_small. lia.
    - assert (amount = bits) as Equal by lia. unfold low. rewrite Equal, Z.sub_diag, Z.pow_0_r, Z.mod_1_r.
      rewrite fill_is. lia. }
  rewrite or_of_is by (unfold is_unsigned; fold amount; lia).
  split; [destruct bit_is as [-> | ->]; nia |].
  destruct (Z.eqb_spec high 0) as [Zero | NotZero].
  - left. split; [reflexivity |]. rewrite Zero in Division. nia.
  - right. split; [reflexivity |]. assert (2 ^ (bits - amount) <= v) by nia.
    destruct bit_is as [-> | ->]; nia.
Qed.

(* After the levels from `power` on: y is shifted by those bits of e, or that does not fit. *)
Definition shifted_so_far (power : nat) (s : Shifted) : Prop :=
  let done := e - e mod 2 ^ Z.of_nat power in
  is_unsigned bits (magnitude s) /\
  (lost s = 0 /\ magnitude s + c = (y + c) * 2 ^ done \/
   lost s = 1 /\ 2 ^ bits - 1 + c < (y + c) * 2 ^ done).

Lemma level_keeps power s :
  0 <= y -> 2 ^ Z.of_nat power <= bits -> shifted_so_far (S power) s ->
  let to := shift_level bits (magnitude s) fill e power in
  shifted_so_far power {| magnitude := magnitude to; lost := Z.lor (lost s) (lost to) |}.
Proof.
  intros Hy Amount [Range So_far]. unfold shifted_so_far. cbn [magnitude lost].
  rewrite Nat2Z.inj_succ, Z.pow_succ_r in So_far by lia.
  set (amount := 2 ^ Z.of_nat power) in *. set (i := Z.of_nat power) in *.
  assert (0 < amount) as AmountPositive by (apply power_positive; lia).
  (* e mod 2^(power+1) is e mod 2^power and the bit. *)
  set (bit := slice e i i). assert (bit = 0 \/ bit = 1) as Bit.
  { unfold bit, slice. replace (i - i + 1) with 1 by lia. change (2 ^ 1) with 2.
    pose proof (Z.mod_pos_bound (e / 2 ^ i) 2). lia. }
  assert (e mod (2 * amount) = e mod amount + amount * bit) as Mod.
  { unfold bit, slice. replace (i - i + 1) with 1 by lia. change (2 ^ 1) with 2. fold amount.
    rewrite (Z.mul_comm 2 amount). apply Z.rem_mul_r; lia. }
  set (before := e - e mod (2 * amount)) in *. set (after := e - e mod amount).
  assert (0 <= before) as BeforePositive by (unfold before; pose proof (Z.mod_le e (2 * amount)); lia).
  assert (after = before + amount * bit) as After by (unfold after, before; lia).
  pose proof (power_positive before BeforePositive) as PowerBefore.
  pose proof (power_positive amount ltac:(lia)) as PowerAmount.
  assert (0 <= c) as CPositive by (destruct bit_is; lia).
  destruct Bit as [Zero | One].
  - (* No shift. *)
    rewrite After, Zero, Z.mul_0_r, Z.add_0_r. unfold shift_level. fold i. fold bit. rewrite Zero.
    cbn [magnitude lost]. change (0 =? 1) with false. cbv iota. rewrite Z.land_0_l, Z.lor_0_r.
    split; assumption.
  - destruct (level_shifts (magnitude s) power Range Amount One) as [Range' Level].
    fold i amount in Level. set (to := shift_level bits (magnitude s) fill e power) in *.
    rewrite After, One, Z.mul_1_r, power_sum by lia. split; [exact Range' |].
    destruct So_far as [[Lost So_far] | [Lost So_far]]; rewrite Lost.
    + rewrite Z.lor_0_l. rewrite So_far in Level.
      destruct Level as [[LostTo Level] | [LostTo Level]]; rewrite LostTo; [left | right];
        (split; [reflexivity | lia]).
    + right. split; [| nia].
      destruct Level as [[-> _] | [-> _]]; reflexivity.
Qed.

Lemma levels_keep power s :
  0 <= y -> (forall p, (p < power)%nat -> 2 ^ Z.of_nat p <= bits) -> shifted_so_far power s ->
  shifted_so_far 0 (shift_levels bits fill e power s).
Proof.
  intros Hy. revert s. induction power as [| power IH]; intros s Amounts So_far; [exact So_far |].
  cbn [shift_levels]. apply IH; [intros; apply Amounts; lia |].
  apply level_keeps; [exact Hy | apply Amounts; lia | exact So_far].
Qed.
End Levels.

Theorem saturating_shift_is_clamp width x e :
  2 <= width -> is_signed width x -> 0 <= e <= width - 1 ->
  saturating_shift width x e =
  Z.max (- 2 ^ (width - 1)) (Z.min (2 ^ (width - 1) - 1) (x * 2 ^ e)).
Proof.
  intros Hw Hx He. unfold saturating_shift.
  rewrite sign_is by (assumption || lia). set (negative := x <? 0). set (bits := width - 1) in *.
  set (c := Z.b2z negative). pose proof (power_positive bits ltac:(lia)) as PowerBits.
  pose proof (twice_power width ltac:(lia)) as Twice. fold bits in Twice.
  unfold is_signed in Hx. fold bits in Hx.
  (* The magnitude: x, or -x - 1 of a negative x. *)
  set (y := if negative then - x - 1 else x).
  assert (is_unsigned bits y) as YRange.
  { unfold is_unsigned, y, negative. destruct (Z.ltb_spec x 0); lia. }
  assert (Z.lxor (slice x (bits - 1) 0) (spread negative bits) = y) as Magnitude.
  { rewrite slice_low, xor_spread by (try apply Z.mod_pos_bound; lia). unfold as_unsigned, y, negative.
    destruct (Z.ltb_spec x 0).
    - replace (x mod 2 ^ bits) with (x + 2 ^ bits); [lia |].
      rewrite <- (Z_mod_plus_full x 1). symmetry. rewrite Z.mul_1_l. apply Z.mod_small. lia.
    - apply Z.mod_small. lia. }
  rewrite Magnitude. clear Magnitude.
  (* The levels. *)
  assert (1 <= Z.log2_up width) as LevelsPositive by (pose proof (Z.log2_up_pos width); lia).
  pose proof (Z.log2_up_spec width ltac:(lia)) as [Less Enough].
  set (top := (count_bits width - 1)%nat).
  assert (Z.of_nat top = Z.log2_up width - 1) as Top by (unfold top, count_bits; lia).
  assert (forall p, (p <= top)%nat -> 2 ^ Z.of_nat p <= bits) as Amounts.
  { intros p Hp. apply Z.le_trans with (2 ^ Z.of_nat top); [apply power_monotone; lia |].
    replace (Z.pred (Z.log2_up width)) with (Z.of_nat top) in Less by lia. unfold bits. lia. }
  assert (shifted_so_far bits e y negative (S top) {| magnitude := y; lost := 0 |}) as Start.
  { unfold shifted_so_far. cbn [magnitude lost]. split; [exact YRange | left]. split; [reflexivity |].
    replace (Z.of_nat (S top)) with (Z.log2_up width) by lia.
    rewrite Z.mod_small by lia. rewrite Z.sub_diag, Z.pow_0_r. lia. }
  apply level_keeps in Start; [| lia | lia | unfold is_unsigned in YRange; lia | apply Amounts; lia].
  cbn [magnitude lost] in Start. rewrite Z.lor_0_l in Start.
  set (first := shift_level bits y (spread negative bits) e top) in *.
  assert (shifted_so_far bits e y negative top first) as First by (destruct first; exact Start).
  apply levels_keep in First; [| lia | lia | unfold is_unsigned in YRange; lia | intros; apply Amounts; lia].
  set (shifted := shift_levels bits (spread negative bits) e top first) in *.
  destruct First as [Range Result]. change (2 ^ Z.of_nat 0) with 1 in Result.
  rewrite Z.mod_1_r, Z.sub_0_r in Result. fold c in Result.
  (* The result: all ones where a bit was lost, then back from one's complement. *)
  rewrite or_spread by (assumption || lia).
  set (m := if lost shifted =? 1 then 2 ^ bits - 1 else magnitude shifted).
  assert (is_unsigned bits m) as MRange.
  { unfold m, is_unsigned in *. destruct (lost shifted =? 1); lia. }
  rewrite xor_spread by (assumption || lia). fold c.
  assert (m + c = Z.min (2 ^ bits - 1 + c) ((y + c) * 2 ^ e)) as Value.
  { unfold m. unfold is_unsigned in *.
    destruct Result as [[-> Result] | [-> Result]]; cbn [Z.eqb Pos.eqb]; lia. }
  unfold is_unsigned in MRange. unfold as_signed, cat. fold bits.
  pose proof (power_positive e ltac:(lia)) as PowerE.
  unfold c, y, negative in *. destruct (Z.ltb_spec x 0); cbn [Z.b2z] in *.
  - destruct (Z.ltb_spec (1 * 2 ^ bits + (2 ^ bits - 1 - m)) (2 ^ bits)); [lia |].
    replace (- x - 1 + 1) with (- x) in Value by lia. rewrite Z.mul_opp_l in Value.
    assert (x * 2 ^ e <= 0) by nia. lia.
  - destruct (Z.ltb_spec (0 * 2 ^ bits + m) (2 ^ bits)); [| lia].
    rewrite !Z.add_0_r in Value. assert (0 <= x * 2 ^ e) by nia. lia.
Qed.
