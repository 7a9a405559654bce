(* Powers of two, floor and ceiling of rational numbers. *)
From Coq Require Import ZArith QArith Qpower Qround Lia Lqa Bool.
Open Scope Z_scope.

(* ---- Powers of two ---- *)

Lemma power_positive k : 0 <= k -> 0 < 2 ^ k.
Proof. intro. apply Z.pow_pos_nonneg; lia. Qed.

Lemma power_sum a b : 0 <= a -> 0 <= b -> 2 ^ (a + b) = 2 ^ a * 2 ^ b.
Proof. intros. apply Z.pow_add_r; assumption. Qed.

Lemma twice_power k : 1 <= k -> 2 ^ k = 2 * 2 ^ (k - 1).
Proof. intro. rewrite <- Z.pow_succ_r by lia. f_equal. lia. Qed.

Lemma power_monotone a b : 0 <= a <= b -> 2 ^ a <= 2 ^ b.
Proof. intro. apply Z.pow_le_mono_r; lia. Qed.

(* 2^k as a rational number. k may be negative. *)
Definition pow2 (k : Z) : Q := Qpower 2 k.

Lemma pow2_positive k : (0 < pow2 k)%Q.
Proof. apply Qpower_0_lt. reflexivity. Qed.

Lemma pow2_plus a b : (pow2 (a + b) == pow2 a * pow2 b)%Q.
Proof. apply Qpower_plus. discriminate. Qed.

Lemma pow2_integer k : 0 <= k -> (inject_Z (2 ^ k) == pow2 k)%Q.
Proof. intro H. exact (Zpower_Qpower 2 k H). Qed.

Lemma pow2_0 : (pow2 0 == 1)%Q.
Proof. reflexivity. Qed.

Lemma pow2_1 : (pow2 1 == 2)%Q.
Proof. reflexivity. Qed.

Lemma pow2_cancel k : (pow2 k * pow2 (- k) == 1)%Q.
Proof. rewrite <- pow2_plus, Z.add_opp_diag_r. reflexivity. Qed.

Lemma pow2_at_least_1 k : 0 <= k -> (1 <= pow2 k)%Q.
Proof.
  intro H. rewrite <- pow2_integer by exact H. change 1%Q with (inject_Z 1). rewrite <- Zle_Qle.
  pose proof (Z.pow_pos_nonneg 2 k). lia.
Qed.

(* ---- Floor and ceiling ---- *)

Lemma inject_minus a b : (inject_Z (a - b) == inject_Z a - inject_Z b)%Q.
Proof. unfold Z.sub. rewrite inject_Z_plus, inject_Z_opp. reflexivity. Qed.

Lemma inject_1 : inject_Z 1 = 1%Q.
Proof. reflexivity. Qed.

Lemma inject_2 : inject_Z 2 = 2%Q.
Proof. reflexivity. Qed.

(* Writes an integer expression inside inject_Z as a rational one. *)
Ltac to_rational H :=
  repeat (first [rewrite inject_minus in H | rewrite inject_Z_plus in H | rewrite inject_Z_mult in H
                | rewrite inject_Z_opp in H]);
  try rewrite inject_1 in H; try rewrite inject_2 in H.

(* x - 1 < floor x <= x, x <= ceiling x < x + 1. *)
Lemma floor_below x : (inject_Z (Qfloor x) <= x)%Q.
Proof. apply Qfloor_le. Qed.

Lemma floor_near x : (x < inject_Z (Qfloor x) + 1)%Q.
Proof. pose proof (Qlt_floor x) as H. to_rational H. exact H. Qed.

Lemma ceiling_above x : (x <= inject_Z (Qceiling x))%Q.
Proof. apply Qle_ceiling. Qed.

Lemma ceiling_near x : (inject_Z (Qceiling x) < x + 1)%Q.
Proof. pose proof (Qceiling_lt x) as H. to_rational H. lra. Qed.

(* The floor is the greatest integer that is not above. *)
Lemma below_floor k x : (inject_Z k <= x)%Q -> k <= Qfloor x.
Proof. intro H. rewrite <- (Qfloor_Z k). apply Qfloor_resp_le. exact H. Qed.

Lemma above_ceiling k x : (x <= inject_Z k)%Q -> Qceiling x <= k.
Proof. intro H. rewrite <- (Qceiling_Z k). apply Qceiling_resp_le. exact H. Qed.

Lemma floor_is k x : (inject_Z k <= x)%Q -> (x < inject_Z k + 1)%Q -> Qfloor x = k.
Proof.
  intros Low High. apply Z.le_antisymm; [| apply below_floor; exact Low].
  pose proof (floor_below x). assert (inject_Z (Qfloor x) < inject_Z (k + 1))%Q as H0.
  { rewrite inject_Z_plus. change (inject_Z 1) with 1%Q. lra. }
  rewrite <- Zlt_Qlt in H0. lia.
Qed.

Lemma ceiling_is k x : (x <= inject_Z k)%Q -> (inject_Z k < x + 1)%Q -> Qceiling x = k.
Proof.
  intros High Low. apply Z.le_antisymm; [apply above_ceiling; exact High |].
  pose proof (ceiling_above x). assert (inject_Z k < inject_Z (Qceiling x + 1))%Q as H0.
  { rewrite inject_Z_plus. change (inject_Z 1) with 1%Q. lra. }
  rewrite <- Zlt_Qlt in H0. lia.
Qed.

(* Division of integers is the floor of the rational quotient. *)
Lemma floor_of_quotient a k : 0 <= k -> Qfloor (inject_Z a * pow2 (- k)) = a / 2 ^ k.
Proof.
  intro Hk. pose proof (Z.pow_pos_nonneg 2 k ltac:(lia) Hk) as Positive.
  pose proof (Z.div_mod a (2 ^ k) ltac:(lia)) as Division.
  pose proof (Z.mod_pos_bound a (2 ^ k) Positive) as [Mod0 Mod1].
  set (q := a / 2 ^ k) in *. set (r := a mod 2 ^ k) in *.
  pose proof (pow2_cancel k) as Cancel. pose proof (pow2_positive (- k)).
  pose proof (pow2_integer k Hk) as Power.
  assert (inject_Z a == pow2 k * inject_Z q + inject_Z r)%Q as Division'.
  { rewrite Division at 1. rewrite inject_Z_plus, inject_Z_mult, Power. reflexivity. }
  rewrite Zle_Qle in Mod0. rewrite Zlt_Qlt, Power in Mod1. change (inject_Z 0) with 0%Q in Mod0.
  assert (inject_Z a * pow2 (- k) == inject_Z q + inject_Z r * pow2 (- k))%Q as Value.
  { rewrite Division'. setoid_replace ((pow2 k * inject_Z q + inject_Z r) * pow2 (- k))%Q with
      (inject_Z q * (pow2 k * pow2 (- k)) + inject_Z r * pow2 (- k))%Q by ring. rewrite Cancel. ring. }
  apply floor_is; rewrite Value; nra.
Qed.
