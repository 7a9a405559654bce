(* The words of hls/num/bits.hpp. A word is its value: a signed word of w bits is in -2^(w-1) .. 2^(w-1) - 1,
   an unsigned one in 0 .. 2^w - 1. *)
From Coq Require Import ZArith Lia Bool.
From HitpipeMajor Require Import Numbers.
Open Scope Z_scope.

(* Bits high .. low, also of a signed word: division rounds down. *)
Definition slice (x high low : Z) : Z := x / 2 ^ low mod 2 ^ (high - low + 1).

(* The bits of a above the `width` bits of b. *)
Definition cat (width a b : Z) : Z := a * 2 ^ width + b.

(* The bits of x as two's complement, and the reverse. *)
Definition as_signed (width x : Z) : Z := if x <? 2 ^ (width - 1) then x else x - 2 ^ width.
Definition as_unsigned (width x : Z) : Z := x mod 2 ^ width.

(* A signed word in another width: its low bits. *)
Definition resize (width x : Z) : Z := as_signed width (as_unsigned width x).

Definition spread (bit : bool) (width : Z) : Z := if bit then 2 ^ width - 1 else 0.

Definition sign (width x : Z) : bool := slice x (width - 1) (width - 1) =? 1.

Definition is_signed (width x : Z) : Prop := - 2 ^ (width - 1) <= x < 2 ^ (width - 1).
Definition is_unsigned (width x : Z) : Prop := 0 <= x < 2 ^ width.

(* The low bits of a signed word, read as a signed word, are the word. *)
Lemma resize_same width x : 1 <= width -> is_signed width x -> resize width x = x.
Proof.
  intros Hw [Low High]. unfold resize, as_signed, as_unsigned.
  pose proof (twice_power width Hw) as Twice. pose proof (power_positive (width - 1) ltac:(lia)).
  destruct (Z_lt_ge_dec x 0) as [Negative | Positive].
  - replace (x mod 2 ^ width) with (x + 2 ^ width).
    + destruct (Z.ltb_spec (x + 2 ^ width) (2 ^ (width - 1))); lia.
    + rewrite <- (Z_mod_plus_full x 1). symmetry. rewrite Z.mul_1_l. apply Z.mod_small. lia.
  - rewrite Z.mod_small by lia. destruct (Z.ltb_spec x (2 ^ (width - 1))); lia.
Qed.

Lemma sign_is width x : 1 <= width -> is_signed width x -> sign width x = (x <? 0).
Proof.
  intros Hw [Low High]. unfold sign, slice. replace (width - 1 - (width - 1) + 1) with 1 by lia.
  pose proof (power_positive (width - 1) ltac:(lia)). change (2 ^ 1) with 2.
  destruct (Z.ltb_spec x 0).
  - replace (x / 2 ^ (width - 1)) with (-1); [reflexivity |].
    apply Z.div_unique with (x + 2 ^ (width - 1)); lia.
  - rewrite Z.div_small by lia. reflexivity.
Qed.

Lemma slice_low x width : slice x (width - 1) 0 = as_unsigned width x.
Proof. unfold slice, as_unsigned. rewrite Z.pow_0_r, Z.div_1_r. f_equal. f_equal. lia. Qed.

Lemma spread_is bit width : spread bit width = Z.b2z bit * (2 ^ width - 1).
Proof. destruct bit; cbn [spread Z.b2z]; lia. Qed.

Lemma unsigned_bit width x i : is_unsigned width x -> width <= i -> Z.testbit x i = false.
Proof.
  intros [Low High] Hi. destruct (Z.eq_dec x 0) as [-> | NotZero]; [apply Z.testbit_0_l |].
  apply Z.bits_above_log2; [lia |]. apply Z.lt_le_trans with width; [| exact Hi].
  apply Z.log2_lt_pow2; lia.
Qed.

Lemma ones_is width : 2 ^ width - 1 = Z.ones width.
Proof. rewrite Z.ones_equiv. lia. Qed.

(* Exclusive-or with ones is -x - 1 in two's complement. *)
Lemma xor_ones width x : 0 <= width -> is_unsigned width x -> Z.lxor x (2 ^ width - 1) = 2 ^ width - 1 - x.
Proof.
  intros Hw Hx. rewrite ones_is.
  enough (x + Z.lxor x (Z.ones width) = Z.ones width) by lia.
  rewrite Z.add_nocarry_lxor.
  - rewrite <- Z.lxor_assoc, Z.lxor_nilpotent, Z.lxor_0_l. reflexivity.
  - apply Z.bits_inj'. intros i Hi. rewrite Z.land_spec, Z.lxor_spec, Z.bits_0.
    destruct (Z_lt_ge_dec i width) as [Inside | Outside].
    + rewrite Z.ones_spec_low by lia. destruct (Z.testbit x i); reflexivity.
    + rewrite (unsigned_bit width x i Hx) by lia. reflexivity.
Qed.

Lemma xor_spread width bit x :
  0 <= width -> is_unsigned width x ->
  Z.lxor x (spread bit width) = if bit then 2 ^ width - 1 - x else x.
Proof. intros. destruct bit; [apply xor_ones; assumption | apply Z.lxor_0_r]. Qed.

Lemma or_spread width bit x :
  0 <= width -> is_unsigned width x ->
  Z.lor x (spread bit width) = if bit then 2 ^ width - 1 else x.
Proof.
  intros Hw Hx. destruct bit; cbn [spread]; [| apply Z.lor_0_r].
  rewrite ones_is. apply Z.bits_inj'. intros i Hi. rewrite Z.lor_spec.
  destruct (Z_lt_ge_dec i width) as [Inside | Outside].
  - rewrite Z.ones_spec_low by lia. apply orb_true_r.
  - rewrite (unsigned_bit width x i Hx), Z.ones_spec_high by lia. reflexivity.
Qed.

Lemma or_small width p q : is_unsigned width p -> is_unsigned width q -> is_unsigned width (Z.lor p q).
Proof.
  intros Hp Hq. assert (0 <= Z.lor p q) as Positive.
  { apply Z.lor_nonneg. unfold is_unsigned in *. lia. }
  assert (0 <= width) as Hw.
  { destruct (Z_lt_ge_dec width 0) as [Negative |]; [| lia]. unfold is_unsigned in *.
    rewrite Z.pow_neg_r in Hp by lia. lia. }
  split; [exact Positive |]. destruct (Z.eq_dec (Z.lor p q) 0) as [-> |]; [apply power_positive; exact Hw |].
  apply Z.log2_lt_pow2; [lia |]. rewrite Z.log2_lor by (unfold is_unsigned in *; lia).
  assert (forall v, is_unsigned width v -> Z.log2 v < width \/ v = 0) as Each.
  { intros v Hv. destruct (Z.eq_dec v 0); [right; assumption | left].
    unfold is_unsigned in Hv. apply Z.log2_lt_pow2; lia. }
  destruct (Each p Hp) as [Lp | ->], (Each q Hq) as [Lq | ->]; try lia.
  - rewrite Z.lor_0_r in *. change (Z.log2 0) with 0. pose proof (Z.log2_nonneg p). lia.
  - rewrite Z.lor_0_l in *. change (Z.log2 0) with 0. pose proof (Z.log2_nonneg q). lia.
  - contradiction.
Qed.

(* hls/pipelines/major_parts.hpp: p + q + 1 in width + 1 bits, by a 1 below both. *)
Definition sum_with_carry (width p q : Z) : Z :=
  let with_one v := as_signed (width + 1) (cat 1 (as_unsigned width v) 1) in
  as_signed (width + 1) (slice (with_one p + with_one q) (width + 1) 1).

Lemma sum_with_carry_is width p q :
  1 <= width -> is_signed width p -> is_signed width q -> sum_with_carry width p q = p + q + 1.
Proof.
  intros Hw Hp Hq. unfold is_signed in *.
  pose proof (twice_power width Hw) as Twice. pose proof (power_positive width ltac:(lia)).
  assert (2 ^ (width + 1) = 2 * 2 ^ width) as Power by (rewrite power_sum by lia; lia).
  assert (forall v, - 2 ^ (width - 1) <= v < 2 ^ (width - 1) ->
          as_signed (width + 1) (cat 1 (as_unsigned width v) 1) = 2 * v + 1) as WithOne.
  { intros v Hv. rewrite <- (resize_same (width + 1) (2 * v + 1)); [unfold resize; f_equal | lia |].
    2: { unfold is_signed. replace (width + 1 - 1) with width by lia. lia. }
    unfold cat, as_unsigned. change (2 ^ 1) with 2. rewrite Power.
    pose proof (Z.div_mod v (2 ^ width) ltac:(lia)). pose proof (Z.mod_pos_bound v (2 ^ width) ltac:(lia)).
    apply Z.mod_unique with (v / 2 ^ width); lia. }
  unfold sum_with_carry. rewrite !WithOne by assumption. unfold slice. change (2 ^ 1) with 2.
  replace (2 * p + 1 + (2 * q + 1)) with ((p + q + 1) * 2) by lia. rewrite Z.div_mul by lia.
  replace (width + 1 - 1 + 1) with (width + 1) by lia.
  apply (resize_same (width + 1)); [lia |]. unfold is_signed. replace (width + 1 - 1) with width by lia. lia.
Qed.
