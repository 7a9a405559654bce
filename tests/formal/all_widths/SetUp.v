(* What the proof takes from the ray set-up and from the boxes. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor.
Open Scope Z_scope.

(* ---- Quotients ---- *)

(* The properties at the top of int_major_ray.hpp, without a division. *)
Record quotient_bounds f (major other : Q) (q : MajorQuotient) : Prop := {
  low_fits : 2 ^ (mantissa f - 1) - 1 <= mantissa_low q <= largest_mantissa f;
  high_fits : 2 ^ (mantissa f - 1) <= mantissa_high q <= largest_mantissa f;
  exponent_fits : 0 <= exponent q <= largest_exponent f;
  quotient_lies_between :
    (0 < other)%Q /\
    (inject_Z (mantissa_low q) * pow2 (exponent q) * other <= pow2 (mantissa f - 1) * major)%Q /\
    (pow2 (mantissa f - 1) * major <= inject_Z (mantissa_high q) * pow2 (exponent q) * other)%Q
    \/
    exponent q = largest_exponent f /\
    (inject_Z (mantissa_low q) * pow2 (largest_exponent f) * other <= pow2 (mantissa f - 1) * major)%Q
}.

Lemma largest_mantissa_is f : 1 <= mantissa f -> largest_mantissa f = 2 * 2 ^ (mantissa f - 1) - 1.
Proof. intro. unfold largest_mantissa. rewrite (twice_power (mantissa f)) by lia. lia. Qed.

(* Undoes the division in scaled_quotient. *)
Lemma scaled_quotient_is f major other e :
  (0 < other)%Q ->
  (scaled_quotient f major other e * (pow2 e * other) == pow2 (mantissa f - 1) * major)%Q.
Proof.
  intro H. unfold scaled_quotient.
  setoid_replace (pow2 (mantissa f - 1) * (major / other) * pow2 (- e) * (pow2 e * other))%Q with
    (pow2 (mantissa f - 1) * major * (pow2 e * pow2 (- e)))%Q by (field; lra).
  rewrite pow2_cancel. ring.
Qed.

Lemma scaled_quotient_halves f major other e :
  (0 < other)%Q ->
  (scaled_quotient f major other e == 2 * scaled_quotient f major other (e + 1))%Q.
Proof.
  intro H. unfold scaled_quotient.
  replace (- e) with (1 + - (e + 1)) by lia. rewrite pow2_plus, pow2_1. ring.
Qed.

Lemma smallest_exponent_found f major other count e found :
  smallest_exponent f major other count e = Some found ->
  e <= found < e + Z.of_nat count /\ fits f major other found = true /\
  (forall smaller, e <= smaller < found -> fits f major other smaller = false).
Proof.
  revert e. induction count as [| count IH]; intros e H; [discriminate |].
  cbn [smallest_exponent] in H. destruct (fits f major other e) eqn:Fits.
  - injection H as <-. repeat split; [lia | lia | exact Fits | intros; lia].
  - apply IH in H. destruct H as [Range [Found Smaller]]. repeat split; [lia | lia | exact Found |].
    intros s Hs. destruct (Z.eq_dec s e) as [-> | Other]; [exact Fits | apply Smaller; lia].
Qed.

Lemma smallest_exponent_none f major other count e :
  smallest_exponent f major other count e = None ->
  forall k, e <= k < e + Z.of_nat count -> fits f major other k = false.
Proof.
  revert e. induction count as [| count IH]; intros e H k Hk; [lia |].
  cbn [smallest_exponent] in H. destruct (fits f major other e) eqn:Fits; [discriminate |].
  destruct (Z.eq_dec k e) as [-> | Other]; [exact Fits | apply (IH (e + 1)); [exact H | lia]].
Qed.

Lemma fits_not f major other e :
  fits f major other e = false -> (inject_Z (largest_mantissa f) < scaled_quotient f major other e)%Q.
Proof.
  unfold fits. rewrite Z.leb_gt. intro H. apply Qnot_le_lt. intro Contra.
  apply above_ceiling in Contra. lia.
Qed.

(* The exponent is as small as possible, so the upper mantissa has its leading bit. *)
Lemma leading_bit f major other e :
  1 <= mantissa f -> (0 < other)%Q -> (other <= major)%Q -> 0 <= e ->
  (forall smaller, 0 <= smaller < e -> fits f major other smaller = false) ->
  (inject_Z (2 ^ (mantissa f - 1)) - 1 < scaled_quotient f major other e)%Q.
Proof.
  intros Hp Ho Hm He Smaller. pose proof (pow2_positive (mantissa f - 1)) as Power.
  destruct (Z.eq_dec e 0) as [-> | NotZero].
  - rewrite pow2_integer by lia. pose proof (scaled_quotient_is f major other 0 Ho) as Eq.
    rewrite pow2_0 in Eq. nra.
  - pose proof (fits_not _ _ _ _ (Smaller (e - 1) ltac:(lia))) as Not.
    rewrite scaled_quotient_halves in Not by exact Ho. replace (e - 1 + 1) with e in Not by lia.
    rewrite largest_mantissa_is, inject_minus, inject_Z_mult in Not by exact Hp.
    rewrite inject_1, inject_2 in Not. lra.
Qed.

Lemma too_large_bounds f major other :
  valid f -> (inject_Z (largest_mantissa f) * pow2 (largest_exponent f) * other <=
              pow2 (mantissa f - 1) * major)%Q ->
  quotient_bounds f major other (too_large f (largest_exponent f)).
Proof.
  intros [] H. pose proof (largest_mantissa_is f ltac:(lia)).
  pose proof (power_positive (mantissa f - 1) ltac:(lia)).
  constructor; cbn; [lia | lia | unfold largest_exponent, point; lia | right; auto].
Qed.

(* The rational definition has the properties. *)
Theorem quotient_has_bounds f major other :
  valid f -> (0 <= other)%Q -> (other <= major)%Q ->
  quotient_bounds f major other (quotient f (largest_exponent f) major other).
Proof.
  intros V Ho Hm. pose proof (pow2_positive (mantissa f - 1)) as Power. unfold quotient.
  destruct (Qeq_bool other 0) eqn:Zero.
  { apply Qeq_bool_iff in Zero. apply too_large_bounds; [exact V |].
    rewrite Zero. assert (0 <= major)%Q by lra. nra. }
  apply Qeq_bool_neq in Zero.
  assert (0 < other)%Q as Positive. { apply Qle_lteq in Ho. destruct Ho as [Ho | Ho]; [exact Ho | lra]. }
  assert (0 <= largest_exponent f) as Largest by (destruct V; unfold largest_exponent, point; lia).
  assert (1 <= mantissa f) as Hp by (destruct V; assumption).
  destruct (smallest_exponent _ _ _ _ _) as [e |] eqn:Search.
  - apply smallest_exponent_found in Search. destruct Search as [Range [Fits Smaller]].
    pose proof (leading_bit f major other e Hp Positive Hm ltac:(lia) Smaller) as Leading.
    pose proof (scaled_quotient_is f major other e Positive) as Eq.
    pose proof (pow2_positive e) as PowerE.
    set (q := scaled_quotient f major other e) in *.
    unfold fits in Fits. fold q in Fits. apply Z.leb_le in Fits.
    pose proof (floor_below q). pose proof (floor_near q). pose proof (ceiling_above q).
    assert (2 ^ (mantissa f - 1) - 1 <= Qfloor q).
    { apply below_floor. rewrite inject_minus, inject_1. lra. }
    assert (2 ^ (mantissa f - 1) <= Qceiling q).
    { enough (2 ^ (mantissa f - 1) - 1 < Qceiling q) by lia.
      rewrite Zlt_Qlt, inject_minus, inject_1. lra. }
    assert (Qfloor q <= Qceiling q) by (rewrite Zle_Qle; lra).
    constructor; cbn [mantissa_low mantissa_high exponent]; [lia | lia | lia |]. left.
    assert (0 < pow2 e * other)%Q by nra.
    split; [exact Positive |]. rewrite <- Eq. split; nra.
  - pose proof (smallest_exponent_none _ _ _ _ _ Search (largest_exponent f) ltac:(lia)) as Not.
    apply fits_not in Not. pose proof (scaled_quotient_is f major other (largest_exponent f) Positive) as Eq.
    pose proof (pow2_positive (largest_exponent f)).
    apply too_large_bounds; [exact V |]. rewrite <- Eq.
    assert (0 < pow2 (largest_exponent f) * other)%Q by nra. nra.
Qed.

(* The upper mantissa is the lower one or the next. *)
Theorem mantissas_adjacent f cap major other :
  let q := quotient f cap major other in
  mantissa_high q = mantissa_low q \/ mantissa_high q = mantissa_low q + 1.
Proof.
  cbv zeta. unfold quotient. destruct (Qeq_bool other 0); [left; reflexivity |].
  destruct (smallest_exponent _ _ _ _ _) as [e |]; [| left; reflexivity].
  cbn [mantissa_low mantissa_high]. set (q := scaled_quotient f major other e).
  pose proof (floor_below q). pose proof (floor_near q). pose proof (ceiling_above q).
  pose proof (ceiling_near q).
  assert (Qfloor q <= Qceiling q) by (rewrite Zle_Qle; lra).
  assert (Qceiling q < Qfloor q + 2).
  { rewrite Zlt_Qlt, inject_Z_plus, inject_2. lra. }
  lia.
Qed.

(* ---- The major axis ---- *)

(* `major_axis` of int_major_ray.cpp: the first of the largest components. *)
Definition major_axis (ray : Ray) : Axis :=
  let larger k best := if Qle_bool (Qabs (direction ray k)) (Qabs (direction ray best)) then best else k in
  larger z (larger y x).

Theorem major_axis_is_major ray : is_major (major_axis ray) ray.
Proof.
  assert (forall p q, Qle_bool p q = false -> (q < p)%Q) as Not.
  { intros p q H. apply Qnot_le_lt. intro Contra. apply Qle_bool_iff in Contra. congruence. }
  intro k. unfold major_axis. cbv zeta.
  destruct (Qle_bool (Qabs (direction ray y)) (Qabs (direction ray x))) eqn:Y;
    [apply Qle_bool_iff in Y | apply Not in Y];
    match goal with |- context [Qle_bool ?p ?q] => destruct (Qle_bool p q) eqn:Z end;
    [apply Qle_bool_iff in Z | apply Not in Z | apply Qle_bool_iff in Z | apply Not in Z];
    destruct k; lra.
Qed.

(* ---- Origins and planes ---- *)

Lemma negative_true c : negative c = true -> (c < 0)%Q.
Proof.
  unfold negative. rewrite negb_true_iff. intro H. apply Qnot_le_lt. intro Contra.
  apply Qle_bool_iff in Contra. congruence.
Qed.

Lemma negative_false c : negative c = false -> (0 <= c)%Q.
Proof. unfold negative. rewrite negb_false_iff. apply Qle_bool_iff. Qed.

(* One unit of the major distance, in the fine grid: G 2^g. *)
Definition scale f : Q := (inject_Z (largest_point f) * pow2 (finer f))%Q.

Lemma grid_positive f : valid f -> 0 <= largest_point f.
Proof. intros []. unfold largest_point. pose proof (power_positive (coord f - 2)). lia. Qed.

Lemma scale_positive f : valid f -> (0 <= scale f)%Q.
Proof.
  intro V. pose proof (grid_positive f V) as H. rewrite Zle_Qle in H.
  pose proof (pow2_positive (finer f)). unfold scale. change (inject_Z 0) with 0%Q in H. nra.
Qed.

(* On the fine grid a plane has moved outward by half a unit at least. *)
Lemma lower_moves f c :
  valid f -> (inject_Z (lower f c * 2 ^ finer f) <= scale f * c - (1 # 2))%Q.
Proof.
  intros []. unfold lower, scale. set (p := (inject_Z (largest_point f) * c - pow2 (- (finer f + 1)))%Q).
  pose proof (floor_below p) as Floor. pose proof (pow2_positive (finer f)).
  rewrite inject_Z_mult, pow2_integer by lia.
  assert (p * pow2 (finer f) == inject_Z (largest_point f) * pow2 (finer f) * c - (1 # 2))%Q.
  { unfold p. pose proof (pow2_cancel (finer f + 1)) as Cancel.
    rewrite pow2_plus, pow2_1 in Cancel.
    assert (pow2 (- (finer f + 1)) * pow2 (finer f) == 1 # 2)%Q by lra. lra. }
  nra.
Qed.

Lemma upper_moves f c :
  valid f -> (scale f * c + (1 # 2) <= inject_Z (upper f c * 2 ^ finer f))%Q.
Proof.
  intros []. unfold upper, scale. set (p := (inject_Z (largest_point f) * c + pow2 (- (finer f + 1)))%Q).
  pose proof (ceiling_above p) as Ceiling. pose proof (pow2_positive (finer f)).
  rewrite inject_Z_mult, pow2_integer by lia.
  assert (p * pow2 (finer f) == inject_Z (largest_point f) * pow2 (finer f) * c + (1 # 2))%Q.
  { unfold p. pose proof (pow2_cancel (finer f + 1)) as Cancel.
    rewrite pow2_plus, pow2_1 in Cancel.
    assert (pow2 (- (finer f + 1)) * pow2 (finer f) == 1 # 2)%Q by lra. lra. }
  nra.
Qed.

Lemma Qabs_negative c : (c < 0)%Q -> (Qabs c == - c)%Q.
Proof. intro. apply Qabs_neg. lra. Qed.

(* The differences bound how far the ray moves on this axis. The far one is greater, never equal. *)
Lemma differences_bound f o d lo hi t :
  valid f -> slope f = 0 -> (lo <= o + t * d <= hi)%Q ->
  let back := negative d in
  let plane := in_ray_order back (lower f lo) (upper f hi) in
  (inject_Z (difference f 0 (near plane) (origin_word f back o) back) <= scale f * (t * Qabs d) <
   inject_Z (difference f 1 (far plane) (origin_word f back o) back))%Q.
Proof.
  intros V Float [Low High]. pose proof (lower_moves f lo V) as Lower. pose proof (upper_moves f hi V) as Upper.
  pose proof (scale_positive f V) as Scale.
  assert (on_fine_grid f o == scale f * o)%Q as Grid by (unfold on_fine_grid, scale; ring).
  destruct (negative d) eqn:Back; cbn [near far in_ray_order];
    unfold difference, mirrored, origin_word; rewrite (in_float_world f Float).
  - rewrite (Qabs_negative d) by (apply negative_true; exact Back).
    pose proof (floor_below (on_fine_grid f o + (1 # 2))) as F0.
    pose proof (floor_near (on_fine_grid f o + (1 # 2))) as F1.
    set (r := Qfloor (on_fine_grid f o + (1 # 2))) in *. rewrite Grid in F0, F1.
    set (l := lower f lo * 2 ^ finer f) in *. set (u := upper f hi * 2 ^ finer f) in *.
    split.
    + assert (inject_Z (- u - 1 - (- r - 1)) == - inject_Z u + inject_Z r)%Q as ->.
      { replace (- u - 1 - (- r - 1)) with (- u + r) by lia. rewrite inject_Z_plus, inject_Z_opp.
        reflexivity. }
      nra.
    + assert (inject_Z (- l - 1 - (- r - 1)) == - inject_Z l + inject_Z r)%Q as ->.
      { replace (- l - 1 - (- r - 1)) with (- l + r) by lia. rewrite inject_Z_plus, inject_Z_opp.
        reflexivity. }
      nra.
  - rewrite (Qabs_pos d) by (apply negative_false; exact Back).
    pose proof (ceiling_above (on_fine_grid f o - (1 # 2))) as C0.
    pose proof (ceiling_near (on_fine_grid f o - (1 # 2))) as C1.
    set (r := Qceiling (on_fine_grid f o - (1 # 2))) in *. rewrite Grid in C0, C1.
    rewrite !inject_minus. split; nra.
Qed.

(* ---- Length ---- *)

(* In the cube the major distance is at most 2 G, so it is below 2^(n-1) units. *)
Lemma scale_is f :
  valid f -> (2 * scale f == pow2 (largest_exponent f) - 2 * pow2 (finer f))%Q.
Proof.
  intros []. unfold scale, largest_exponent, largest_point, point.
  rewrite inject_minus, inject_1, pow2_integer by lia.
  replace (coord f + finer f - 1) with (coord f - 2 + finer f + 1) by lia.
  rewrite !pow2_plus, pow2_1. ring.
Qed.

Lemma pow2_negative_below k : k <= 0 -> (pow2 k <= 1)%Q.
Proof.
  intro. pose proof (pow2_at_least_1 (- k) ltac:(lia)). pose proof (pow2_cancel k).
  pose proof (pow2_positive k). nra.
Qed.

(* A distance along the ray that ends in the cube is within the length's word. *)
Lemma below_length f major l t :
  valid f -> (0 <= major)%Q -> (0 <= t)%Q ->
  (scale f * (t * major) <= 2 * scale f)%Q ->
  (forall l', l = Some l' -> (t <= l')%Q) ->
  Qfloor (scale f * (t * major) * pow2 (fraction f - finer f)) <= length_word f major l.
Proof.
  intros V Hm Ht Cube Length. set (T := (scale f * (t * major))%Q) in *.
  pose proof (pow2_positive (fraction f - finer f)) as P.
  assert (Qfloor (T * pow2 (fraction f - finer f)) <= largest_length f) as Largest.
  { assert (T * pow2 (fraction f - finer f) < inject_Z (2 ^ (coord f + fraction f - 1)))%Q as Below.
    { rewrite scale_is in Cube by exact V. destruct V.
      rewrite pow2_integer by lia.
      replace (coord f + fraction f - 1) with (largest_exponent f + (fraction f - finer f))
        by (unfold largest_exponent, point; lia).
      rewrite pow2_plus. pose proof (pow2_positive (finer f)).
      assert (T < pow2 (largest_exponent f))%Q by lra. nra. }
    pose proof (floor_below (T * pow2 (fraction f - finer f))) as Floor.
    enough (Qfloor (T * pow2 (fraction f - finer f)) < 2 ^ (coord f + fraction f - 1))
      by (unfold largest_length; lia).
    rewrite Zlt_Qlt. lra. }
  destruct l as [l |]; cbn [length_word]; [| exact Largest].
  apply Z.min_glb; [| exact Largest]. apply Qfloor_resp_le.
  specialize (Length l eq_refl). unfold T, scale.
  setoid_replace (inject_Z (largest_point f) * pow2 (finer f) * (t * major) * pow2 (fraction f - finer f))%Q
    with (t * major * inject_Z (largest_point f) * (pow2 (finer f) * pow2 (fraction f - finer f)))%Q by ring.
  rewrite <- pow2_plus. replace (finer f + (fraction f - finer f)) with (fraction f) by lia.
  pose proof (grid_positive f V) as G. rewrite Zle_Qle in G. change (inject_Z 0) with 0%Q in G.
  pose proof (pow2_positive (fraction f)).
  apply Qmult_le_compat_r; [| lra]. apply Qmult_le_compat_r; [| exact G].
  apply Qmult_le_compat_r; assumption.
Qed.

Lemma length_word_at_most f major l : length_word f major l <= largest_length f.
Proof. unfold length_word. destruct l; lia. Qed.
