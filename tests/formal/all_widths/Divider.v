(* The divider of the integer world (hls/machines/divider.hpp): two bits of the quotient in a step, without
   restoring. For all widths: after enough steps the bits are the floor of the quotient. *)
From Coq Require Import ZArith Bool Lia.
Open Scope Z_scope.

Definition bit (b : bool) : Z := if b then 1 else 0.

(* ---- A step ---- *)

Record Digits := { first : bool; second : bool; remainder : Z }.

(* det may be negative; r is the remainder, and x1 and x0 are the next two bits of what is divided. *)
Definition subtracts (det r : Z) : bool := negb (xorb (r <? 0) (det <? 0)).
Definition change (subtracted : bool) (x : Z) : Z := Z.lxor x (if subtracted then -1 else 0) + bit subtracted.
Definition bound (subtracted : bool) (det : Z) : Z :=
  2 * Z.lxor det (if subtracted then 0 else -1) + bit (negb subtracted).
Definition step (det r : Z) (x1 x0 : bool) : Digits :=
  let subtracted := subtracts det r in
  let first_negative := 2 * (2 * r + bit x1) <? bound subtracted det in
  let quadrupled := 4 * r + 2 * bit x1 + bit x0 in
  let next := quadrupled + change subtracted (if xorb first_negative (r <? 0) then det else 3 * det) in
  {| first := negb first_negative; second := negb (next <? 0); remainder := next |}.

(* What is left of the dividend when a remainder below 0 is restored. *)
Definition restored (det r : Z) : Z := if r <? 0 then r + Z.abs det else r.

Lemma change_is subtracted x : change subtracted x = if subtracted then - x else x.
Proof.
  unfold change; destruct subtracted; cbn [bit].
  - rewrite Z.lxor_m1_r. unfold Z.lnot. lia.
  - rewrite Z.lxor_0_r. lia.
Qed.

Lemma bound_is subtracted det : bound subtracted det = if subtracted then 2 * det else - (2 * det) - 1.
Proof.
  unfold bound; destruct subtracted; cbn [bit negb].
  - rewrite Z.lxor_0_r. lia.
  - rewrite Z.lxor_m1_r. unfold Z.lnot. lia.
Qed.

Theorem step_divides det r x1 x0 :
  det <> 0 -> - Z.abs det <= r < Z.abs det ->
  let made := step det r x1 x0 in
  4 * restored det r + 2 * bit x1 + bit x0
    = Z.abs det * (2 * bit (first made) + bit (second made)) + restored det (remainder made)
  /\ - Z.abs det <= remainder made < Z.abs det
  /\ 0 <= restored det (remainder made) < Z.abs det.
Proof.
  intros not_zero range made; subst made.
  unfold step, subtracts, restored; cbn [first second remainder].
  rewrite bound_is, change_is.
  destruct x1, x0; cbn [bit];
    destruct (Z.ltb_spec r 0); destruct (Z.ltb_spec det 0); cbn [xorb negb];
    match goal with |- context [?a <? ?b] => destruct (Z.ltb_spec a b) end; cbn [xorb negb bit];
    match goal with |- context [?a <? 0] => destruct (Z.ltb_spec a 0) end; cbn [xorb negb bit]; lia.
Qed.

(* ---- All steps ---- *)

(* The dividend n in `steps` steps, from its top: the quotient's bits, and the remainder. *)
Fixpoint divide (steps : nat) (n det : Z) : Z * Z :=
  match steps with
  | O => (0, n)
  | S before =>
      let '(quotient, r) := divide before (n / 4) det in
      let made := step det r (Z.odd (n / 2)) (Z.odd n) in
      (4 * quotient + 2 * bit (first made) + bit (second made), remainder made)
  end.

Lemma low_bits n : n = 4 * (n / 4) + 2 * bit (Z.odd (n / 2)) + bit (Z.odd n).
Proof.
  assert (two : forall m, m = 2 * (m / 2) + bit (Z.odd m)).
  { intro m. rewrite (Z.div_mod m 2) at 1 by lia. rewrite Zmod_odd. unfold bit. destruct (Z.odd m); lia. }
  assert (four : n / 4 = n / 2 / 2) by (rewrite Z.div_div by lia; reflexivity).
  rewrite four. pose proof (two n). pose proof (two (n / 2)). lia.
Qed.

Lemma divide_is steps : forall n det, det <> 0 -> 0 <= n -> n / 4 ^ Z.of_nat steps < Z.abs det ->
  let '(quotient, r) := divide steps n det in
  n = Z.abs det * quotient + restored det r /\ - Z.abs det <= r < Z.abs det /\ 0 <= restored det r < Z.abs det.
Proof.
  induction steps as [|before IH]; intros n det not_zero natural top.
  - cbn [divide]. change (4 ^ Z.of_nat 0) with 1 in top. rewrite Z.div_1_r in top.
    unfold restored. destruct (Z.ltb_spec n 0); lia.
  - assert (top_before : n / 4 / 4 ^ Z.of_nat before < Z.abs det).
    { rewrite Z.div_div by (try apply Z.pow_pos_nonneg; lia).
      rewrite <- Z.pow_succ_r by lia. rewrite <- Nat2Z.inj_succ. exact top. }
    specialize (IH (n / 4) det not_zero ltac:(apply Z.div_pos; lia) top_before).
    cbn [divide]. destruct (divide before (n / 4) det) as [quotient r].
    destruct IH as (is_n & range & rest).
    pose proof (step_divides det r (Z.odd (n / 2)) (Z.odd n) not_zero range) as stepped. cbn zeta in stepped.
    destruct stepped as (identity & range_next & rest_next).
    split; [|split; assumption].
    rewrite (low_bits n) at 1. rewrite is_n. lia.
Qed.

(* The quotient is the floor, if it has no more bits than the steps make. *)
Theorem divide_is_floor steps n det :
  det <> 0 -> 0 <= n < 4 ^ Z.of_nat steps * Z.abs det -> fst (divide steps n det) = n / Z.abs det.
Proof.
  intros not_zero range.
  assert (top : n / 4 ^ Z.of_nat steps < Z.abs det).
  { apply Z.div_lt_upper_bound; [apply Z.pow_pos_nonneg|]; lia. }
  pose proof (divide_is steps n det not_zero (proj1 range) top) as is.
  destruct (divide steps n det) as [quotient r]. cbn [fst].
  apply Z.div_unique_pos with (r := restored det r); lia.
Qed.

(* T of a hit: num 2^(S+F) / det, of at most 2 steps bits. The machine keeps the remainder in as many bits as
   det has, and it fits. *)
Theorem distance_is_floor steps slope fraction num det :
  det <> 0 -> 0 <= slope -> 0 <= fraction ->
  2 ^ (slope + fraction) * Z.abs num < 4 ^ Z.of_nat steps * Z.abs det ->
  fst (divide steps (2 ^ (slope + fraction) * Z.abs num) det) = 2 ^ (slope + fraction) * Z.abs num / Z.abs det.
Proof.
  intros. apply divide_is_floor; [assumption|].
  assert (0 <= 2 ^ (slope + fraction)) by (apply Z.pow_nonneg; lia). nia.
Qed.

Theorem remainder_fits bits det r :
  1 <= bits -> Z.abs det < 2 ^ (bits - 1) -> - Z.abs det <= r < Z.abs det ->
  - 2 ^ (bits - 1) <= r < 2 ^ (bits - 1).
Proof. lia. Qed.
