(* The unit never misses: it answers 1 whenever the exact ray meets the exact box, in every format of the float
   world. T is the exact distance of a common point, in the fine grid along the major axis. In the unit's
   distances it is floor(T 2^(F-g)). Each slab's near distance is not above that number, and its far distance is
   not below it. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor SetUp.
Open Scope Z_scope.

(* T as a distance of the unit. *)
Definition as_distance f (T : Q) : Z := Qfloor (T * pow2 (fraction f - finer f)).

Lemma as_distance_not_negative f T : (0 <= T)%Q -> 0 <= as_distance f T.
Proof.
  intro H. apply below_floor. pose proof (pow2_positive (fraction f - finer f)).
  change (inject_Z 0) with 0%Q. nra.
Qed.

(* Dropping low bits is floor, and floor keeps the order. *)
Lemma product_below f product T :
  valid f -> (inject_Z product <= pow2 (mantissa f - 1) * T)%Q ->
  product / 2 ^ trimmed f <= as_distance f T.
Proof.
  intros [] H. rewrite <- floor_of_quotient by assumption. apply Qfloor_resp_le.
  pose proof (pow2_positive (- trimmed f)).
  replace (fraction f - finer f) with (mantissa f - 1 + - trimmed f) by (unfold trimmed; lia).
  rewrite pow2_plus. nra.
Qed.

Lemma product_above f product T :
  valid f -> (pow2 (mantissa f - 1) * T <= inject_Z product)%Q ->
  as_distance f T <= product / 2 ^ trimmed f.
Proof.
  intros [] H. rewrite <- floor_of_quotient by assumption. apply Qfloor_resp_le.
  pose proof (pow2_positive (- trimmed f)).
  replace (fraction f - finer f) with (mantissa f - 1 + - trimmed f) by (unfold trimmed; lia).
  rewrite pow2_plus. nra.
Qed.

(* ---- The major axis: the difference is the distance ---- *)

Lemma major_distance_is f d : major_distance f d = as_distance f (inject_Z d).
Proof.
  unfold major_distance, as_distance. unfold Z.sub. rewrite pow2_plus, Qmult_assoc. reflexivity.
Qed.

Lemma as_distance_monotone f T U : (T <= U)%Q -> as_distance f T <= as_distance f U.
Proof.
  intro H. apply Qfloor_resp_le. pose proof (pow2_positive (fraction f - finer f)). nra.
Qed.

(* ---- The other axes ---- *)

(* moved is how far the ray moves on this axis: moved |D_M| = T |D_k|. *)
Section OtherAxis.
Variables (f : Format) (major other : Q) (q : MajorQuotient) (moved T : Q).
Hypothesis (V : valid f) (Bounds : quotient_bounds f major other q).
Hypothesis (Ratio : (moved * major == T * other)%Q) (MovedPositive : (0 <= moved)%Q) (TPositive : (0 <= T)%Q).
Hypothesis (OtherPositive : (0 <= other)%Q) (MajorPositive : (0 <= major)%Q).
(* A component of 0 does not move the ray. *)
Hypothesis (NoMove : (other == 0)%Q -> (moved == 0)%Q).
(* Nothing in the cube is farther. *)
Hypothesis (Cube : (T <= pow2 (largest_exponent f) - 1)%Q).

Let E := largest_exponent f.

Lemma exponent_positive : 0 <= E.
Proof. destruct V. unfold E, largest_exponent, point. lia. Qed.

Lemma shift_is d e : saturating_shift f d e = Z.max (- 2 ^ E) (Z.min (2 ^ E - 1) (d * 2 ^ e)).
Proof. reflexivity. Qed.

Lemma near_is_early d :
  (inject_Z d <= moved)%Q ->
  scaled_distance f d (if d <? 0 then mantissa_high q else mantissa_low q) (exponent q) <= as_distance f T.
Proof using All.
  intro Hd. destruct Bounds as [Low High Exp Between]. pose proof exponent_positive as HE.
  pose proof (power_positive (mantissa f - 1)) as PowerM. assert (1 <= mantissa f) by (destruct V; lia).
  pose proof (power_positive E HE) as PowerE. pose proof (power_positive (exponent q)) as PowerQ.
  pose proof (pow2_positive (mantissa f - 1)) as PositiveM.
  unfold scaled_distance. apply product_below; [exact V |].
  rewrite shift_is. set (s := Z.max _ _).
  destruct (Z.ltb_spec d 0) as [Behind | Ahead].
  - (* A negative difference stays negative, and T is not. *)
    assert (s <= 0) by (unfold s; nia).
    assert (s * mantissa_high q <= 0) as Negative by nia. rewrite Zle_Qle in Negative.
    change (inject_Z 0) with 0%Q in Negative. nra.
  - destruct Between as [[Positive [Between _]] | [IsExp Between]].
    + (* Saturation and the lower mantissa both make it smaller. *)
      assert (s <= d * 2 ^ exponent q) by (unfold s; nia).
      assert (s * mantissa_low q <= d * 2 ^ exponent q * mantissa_low q) as Product by nia.
      rewrite Zle_Qle in Product. rewrite !inject_Z_mult, pow2_integer in Product by lia.
      rewrite inject_Z_mult.
      rewrite Zle_Qle in Ahead. change (inject_Z 0) with 0%Q in Ahead.
      set (D := inject_Z d) in *. set (L := inject_Z (mantissa_low q)) in *.
      set (P := pow2 (exponent q)) in *. set (S := inject_Z s) in *. set (M := pow2 (mantissa f - 1)) in *.
      apply Qmult_lt_0_le_reg_r with other; [exact Positive |].
      apply Qle_trans with (D * (L * P * other))%Q; [nra |].
      apply Qle_trans with (D * (M * major))%Q; [nra |].
      apply Qle_trans with (moved * (M * major))%Q; [apply Qmult_le_compat_r; nra |].
      setoid_replace (moved * (M * major))%Q with (M * (moved * major))%Q by ring. rewrite Ratio. nra.
    + (* The exponent is the largest. The difference 0 gives 0. From 1 on the product is below
         the quotient. *)
      fold E in Between.
      destruct (Z.eq_dec d 0) as [-> | NotZero].
      { assert (s = 0) as -> by (unfold s; rewrite Z.mul_0_l; lia). rewrite Z.mul_0_l.
        change (inject_Z 0) with 0%Q. nra. }
      assert (2 ^ E <= d * 2 ^ E) by nia.
      assert (s = 2 ^ E - 1) as -> by (unfold s; rewrite IsExp; fold E; lia).
      assert ((2 ^ E - 1) * mantissa_low q <= 2 ^ E * mantissa_low q) as Product by nia.
      rewrite Zle_Qle in Product. rewrite (inject_Z_mult (2 ^ E)), pow2_integer in Product by lia.
      assert (1 <= d) as One by lia. rewrite Zle_Qle in One. change (inject_Z 1) with 1%Q in One.
      set (X := inject_Z ((2 ^ E - 1) * mantissa_low q)) in *.
      set (L := inject_Z (mantissa_low q)) in *.
      set (P := pow2 E) in *. set (M := pow2 (mantissa f - 1)) in *.
      assert (0 < other)%Q as Positive.
      { apply Qnot_le_lt. intro Contra. assert (other == 0)%Q as Zero by lra. apply NoMove in Zero. lra. }
      assert (0 <= L * P)%Q.
      { unfold L, P. rewrite <- pow2_integer by lia. rewrite <- inject_Z_mult.
        change 0%Q with (inject_Z 0). rewrite <- Zle_Qle.
        apply Z.mul_nonneg_nonneg; lia. }
      apply Qle_trans with (L * P)%Q; [lra |].
      apply Qmult_lt_0_le_reg_r with other; [exact Positive |].
      apply Qle_trans with (M * major)%Q; [exact Between |].
      assert (0 <= M * major)%Q by nra.
      apply Qle_trans with (M * (moved * major))%Q; [| rewrite Ratio; nra].
      setoid_replace (M * (moved * major))%Q with (moved * (M * major))%Q by ring. nra.
Qed.

Lemma far_is_late d :
  (moved < inject_Z d)%Q ->
  as_distance f T <= scaled_distance f d (if d <? 0 then mantissa_low q else mantissa_high q) (exponent q).
Proof using All.
  intro Hd. destruct Bounds as [Low High Exp Between]. pose proof exponent_positive as HE.
  pose proof (power_positive (mantissa f - 1)) as PowerM. assert (1 <= mantissa f) by (destruct V; lia).
  pose proof (power_positive E HE) as PowerE. pose proof (power_positive (exponent q)) as PowerQ.
  pose proof (pow2_positive (mantissa f - 1)) as PositiveM.
  assert (1 <= d) as One.
  { enough (0 < d) by lia. rewrite Zlt_Qlt. change (inject_Z 0) with 0%Q. lra. }
  destruct (Z.ltb_spec d 0); [lia |].
  unfold scaled_distance. apply product_above; [exact V |].
  rewrite shift_is. set (s := Z.max _ _).
  destruct (Z_le_gt_dec (2 ^ E - 1) (d * 2 ^ exponent q)) as [Saturated | Fits].
  - (* The saturated value is beyond the cube. *)
    assert (s = 2 ^ E - 1) as -> by (unfold s; nia).
    assert ((2 ^ E - 1) * 2 ^ (mantissa f - 1) <= (2 ^ E - 1) * mantissa_high q) as Product by nia.
    rewrite Zle_Qle in Product.
    rewrite (inject_Z_mult (2 ^ E - 1) (2 ^ (mantissa f - 1))), inject_minus, inject_1 in Product.
    rewrite (pow2_integer (mantissa f - 1)), (pow2_integer E) in Product by lia. fold E in Cube. nra.
  - assert (s = d * 2 ^ exponent q) as -> by (unfold s; nia).
    destruct Between as [[Positive [_ Between]] | [IsExp _]].
    + rewrite !inject_Z_mult, pow2_integer by lia.
      set (D := inject_Z d) in *. set (H' := inject_Z (mantissa_high q)) in *.
      set (P := pow2 (exponent q)) in *. set (M := pow2 (mantissa f - 1)) in *.
      apply Qmult_lt_0_le_reg_r with other; [exact Positive |].
      apply Qle_trans with (D * (M * major))%Q; [| nra].
      setoid_replace (M * T * other)%Q with (moved * (M * major))%Q.
      * apply Qmult_le_compat_r; [lra | nra].
      * rewrite <- (Qmult_assoc M T), <- Ratio. ring.
    + (* The largest exponent shifts every positive difference out of the word. *)
      rewrite IsExp in Fits. fold E in Fits. nia.
Qed.

Lemma slab_holds (d : NearFar Z) :
  (inject_Z (near d) <= moved < inject_Z (far d))%Q ->
  let slab := scaled_slab f d (mantissa_low q) (mantissa_high q) (exponent q) in
  near slab <= as_distance f T <= far slab.
Proof using All. intros [Near Far]. split; [apply near_is_early | apply far_is_late]; assumption. Qed.
End OtherAxis.

Lemma major_slab_holds f T (d : NearFar Z) :
  (inject_Z (near d) <= T < inject_Z (far d))%Q ->
  major_distance f (near d) <= as_distance f T <= major_distance f (far d).
Proof.
  intros [Near Far]. rewrite !major_distance_is. split; apply as_distance_monotone.
  - exact Near.
  - apply Qlt_le_weak. exact Far.
Qed.

(* ---- All three slabs ---- *)

(* The distance D lies between the near and the far distance of each slab. *)
Definition slabs_hold f (ray : MajorRay) (planes : MajorPlanes) (D : Z) : Prop :=
  let t := plane_distances f ray planes in
  near (m t) <= D <= far (m t) /\ near (a t) <= D <= far (a t) /\ near (b t) <= D <= far (b t).

(* What is left of the unit is a maximum of three numbers and a minimum of three. *)
Lemma test_accepts f ray planes D :
  slabs_hold f ray planes D -> 0 <= D <= len ray -> test f ray planes = true.
Proof.
  unfold slabs_hold, test, test_with. fold plane_distances. cbv zeta.
  rewrite !andb_true_iff, !Z.leb_le. lia.
Qed.

Section Slabs.
Variables (f : Format) (major : Axis) (ray : Ray) (box : Box) (t : Q).
Hypothesis (V : valid f) (Float : slope f = 0) (Major : is_major major ray).
Hypothesis (RayOk : acceptable_ray ray) (BoxOk : acceptable_box box).
Hypothesis (Start : (0 <= t)%Q).
Hypothesis (Inside : forall k, (lo box k <= origin ray k + t * direction ray k <= hi box k)%Q).

Let largest := Qabs (direction ray major).
(* The exact distance of the common point. *)
Let T := (scale f * (t * largest))%Q.

Lemma T_positive : (0 <= T)%Q.
Proof using V Start.
  pose proof (scale_positive f V). pose proof (Qabs_nonneg (direction ray major)) as H0. fold largest in H0.
  unfold T. apply Qmult_le_0_compat; [assumption |]. apply Qmult_le_0_compat; assumption.
Qed.

(* Two points of the cube are at most 2 apart on each axis. *)
Lemma T_in_cube : (T <= 2 * scale f)%Q.
Proof using V Start RayOk BoxOk Inside.
  pose proof (scale_positive f V) as S. destruct (origin_in_cube ray RayOk major) as [O0 O1].
  destruct (BoxOk major) as [[L0 _] [_ H1]]. destruct (Inside major) as [I0 I1].
  assert (t * largest <= 2)%Q as Two.
  { unfold largest. destruct (Qlt_le_dec (direction ray major) 0).
    - rewrite Qabs_negative by assumption. lra.
    - rewrite Qabs_pos by assumption. lra. }
  unfold T. nra.
Qed.

Lemma T_below_largest : (T <= pow2 (largest_exponent f) - 1)%Q.
Proof using V Start RayOk BoxOk Inside.
  pose proof T_in_cube as H. rewrite scale_is in H by exact V. destruct V.
  pose proof (pow2_at_least_1 (finer f) ltac:(lia)). lra.
Qed.

(* The planes of axis k as ray axis `s` sees them. *)
Let back k := negative (direction ray k).
Let word k := origin_word f (back k) (origin ray k).
Let plane k := in_ray_order (back k) (lower f (lo box k)) (upper f (hi box k)).
Let d k := {| near := difference f 0 (near (plane k)) (word k) (back k);
             far := difference f 1 (far (plane k)) (word k) (back k) |}.
Let q k := quotient f (largest_exponent f) largest (Qabs (direction ray k)).

Lemma major_slab :
  major_distance f (near (d major)) <= as_distance f T <= major_distance f (far (d major)).
Proof using V Float Inside. apply major_slab_holds. apply differences_bound; auto. Qed.

Lemma other_slab k :
  let slab := scaled_slab f (d k) (mantissa_low (q k)) (mantissa_high (q k)) (exponent (q k)) in
  near slab <= as_distance f T <= far slab.
Proof using All.
  pose proof (Qabs_nonneg (direction ray k)) as K0. pose proof (Qabs_nonneg (direction ray major)) as M0.
  pose proof (quotient_has_bounds f largest (Qabs (direction ray k)) V K0 (Major k)) as Bounds.
  pose proof (scale_positive f V) as S. set (moved := (scale f * (t * Qabs (direction ray k)))%Q) in *.
  assert (moved * largest == T * Qabs (direction ray k))%Q as Ratio by (unfold moved, T; ring).
  assert (0 <= moved)%Q as MovedPositive.
  { unfold moved. apply Qmult_le_0_compat; [assumption |]. apply Qmult_le_0_compat; assumption. }
  assert (Qabs (direction ray k) == 0 -> moved == 0)%Q as NoMove.
  { intro Zero. unfold moved. rewrite Zero. ring. }
  pose proof T_positive. pose proof T_below_largest. fold largest in M0.
  apply (slab_holds f largest (Qabs (direction ray k)) (q k) moved); try assumption.
  apply differences_bound; auto.
Qed.

Local Opaque major_distance scaled_slab difference.

Lemma float_slabs_hold : slabs_hold f (set_up f major ray) (quantise_box f box) (as_distance f T).
Proof using All.
  pose proof major_slab as InM. pose proof (other_slab (axis_a major)) as InA.
  pose proof (other_slab (axis_b major)) as InB. unfold d, plane, word, back in *.
  destruct major; repeat split; try apply InM; try apply InA; apply InB.
Qed.
End Slabs.

(* The main theorem. *)
Theorem never_misses :
  forall (f : Format) (major : Axis) (ray : Ray) (box : Box),
    valid f -> slope f = 0 -> is_major major ray -> acceptable_ray ray -> acceptable_box box ->
    meets ray box -> hit f major ray box = true.
Proof.
  intros f major ray box V Float Major RayOk BoxOk [t [Start [End Inside]]]. unfold hit.
  apply test_accepts with (as_distance f (scale f * (t * Qabs (direction ray major)))).
  - apply float_slabs_hold; assumption.
  - split; [apply as_distance_not_negative; apply (T_positive f major ray t V Start) |].
    exact (below_length f _ (length ray) t V (Qabs_nonneg _) Start
             (T_in_cube f major ray box t V RayOk BoxOk Start Inside) End).
Qed.
