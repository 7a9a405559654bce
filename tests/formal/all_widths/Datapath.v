(* The datapath as the C++ writes it, in words of the declared widths, equals the unit in integers. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor SetUp NeverMisses Words.
From HitpipeMajor Require Shifter.
Open Scope Z_scope.

(* ---- hls/pipelines/major_parts.hpp, int_major.hpp in words ---- *)

Definition on_fine_grid_words f (plane : Z) (back : bool) : Z :=
  let mirrored := as_signed (coord f) (Z.lxor (as_unsigned (coord f) plane) (spread back (coord f))) in
  if 0 <? finer f
  then as_signed (point f) (cat (finer f) (as_unsigned (coord f) mirrored) (spread back (finer f)))
  else mirrored.

Definition near_difference_words f (plane origin : Z) (back : bool) : Z :=
  let fine := on_fine_grid_words f plane back in
  resize (point f) (if integer_world f then fine + origin else fine - origin).

Definition far_difference_words f (plane origin : Z) (back : bool) : Z :=
  let fine := on_fine_grid_words f plane back in
  resize (point f) (if integer_world f then sum_with_carry (point f) fine origin else fine - origin).

Definition major_distance_words f (d : Z) : Z :=
  let fewer := if fraction f <? finer f
               then as_signed (coord f + fraction f) (slice d (point f - 1) (finer f - fraction f))
               else d in
  let more := if finer f <? fraction f
              then as_signed (coord f + fraction f)
                     (cat (fraction f - finer f) (as_unsigned (point f) fewer) 0)
              else fewer in
  resize (distance f) more.

Definition scaled_distance_words f (d mantissa_word exponent : Z) : Z :=
  let shifted := Shifter.saturating_shift (point f) d exponent in
  let product := resize (point f + mantissa f) (shifted * mantissa_word) in
  as_signed (distance f) (slice product (point f + mantissa f - 1) (trimmed f)).

Definition scaled_slab_words f (d : NearFar Z) (floor ceil exponent : Z) : NearFar Z :=
  let near_bound := if sign (point f) (near d) then ceil else floor in
  let far_bound := if sign (point f) (far d) then floor else ceil in
  {| near := scaled_distance_words f (near d) near_bound exponent;
     far := scaled_distance_words f (far d) far_bound exponent |}.

Definition plane_distances_words f (ray : MajorRay) (planes : MajorPlanes) : RayAxes (NearFar Z) :=
  let low := to_ray_axes ray (xmin planes) (ymin planes) (zmin planes) in
  let high := to_ray_axes ray (xmax planes) (ymax planes) (zmax planes) in
  let differences back lower upper origin :=
    let plane := in_ray_order back lower upper in
    {| near := near_difference_words f (near plane) origin back;
       far := far_difference_words f (far plane) origin back |} in
  let dm := differences (back_m ray) (m low) (m high) (origin_m ray) in
  let da := differences (back_a ray) (a low) (a high) (origin_a ray) in
  let db := differences (back_b ray) (b low) (b high) (origin_b ray) in
  {| m := {| near := major_distance_words f (near dm); far := major_distance_words f (far dm) |};
     a := scaled_slab_words f da (floor_a ray) (ceil_a ray) (exp_a ray);
     b := scaled_slab_words f db (floor_b ray) (ceil_b ray) (exp_b ray) |}.

Definition greater (x y : Z) : Z := if x <? y then y else x.
Definition lesser (x y : Z) : Z := if y <? x then y else x.

Definition test_words f (ray : MajorRay) (planes : MajorPlanes) : bool :=
  let t := plane_distances_words f ray planes in
  let near := greater (greater (near (m t)) (near (a t))) (near (b t)) in
  let far := lesser (lesser (far (m t)) (far (a t))) (far (b t)) in
  let behind := sign (distance f) far in
  let apart := far <? near in
  let beyond := len ray <? near in
  negb behind && negb apart && negb beyond.

(* ---- Operands ---- *)

(* What the operands' declared ranges say, that an origin is mirrored or negated from a point of the grid, and
   that planes of the integer world do not grow. *)
Definition origin_fits f (back : bool) (o : Z) : Prop :=
  let plain := if integer_world f then if back then o - 1 else - o else mirrored back o in
  Z.abs plain <= largest_point f * 2 ^ finer f.
Definition plane_fits f (p : Z) : Prop :=
  Z.abs p <= if integer_world f then largest_point f else largest_point f + 1.
Definition mantissa_fits f (bound : Z) : Prop := 0 <= bound <= largest_mantissa f.
Definition exponent_in_range f (e : Z) : Prop := 0 <= e <= largest_exponent f.

Record operands_fit f (ray : MajorRay) (planes : MajorPlanes) : Prop := {
  fits_origin_m : origin_fits f (back_m ray) (origin_m ray);
  fits_origin_a : origin_fits f (back_a ray) (origin_a ray);
  fits_origin_b : origin_fits f (back_b ray) (origin_b ray);
  fits_floor_a : mantissa_fits f (floor_a ray);
  fits_ceil_a : mantissa_fits f (ceil_a ray);
  fits_floor_b : mantissa_fits f (floor_b ray);
  fits_ceil_b : mantissa_fits f (ceil_b ray);
  fits_exp_a : exponent_in_range f (exp_a ray);
  fits_exp_b : exponent_in_range f (exp_b ray);
  fits_len : 0 <= len ray <= largest_length f;
  fits_planes : plane_fits f (xmin planes) /\ plane_fits f (xmax planes) /\ plane_fits f (ymin planes) /\
                plane_fits f (ymax planes) /\ plane_fits f (zmin planes) /\ plane_fits f (zmax planes)
}.

(* ---- Widths of the operands, as major_format.hpp declares them ---- *)

Section Widths.
Variable f : Format.
Hypothesis V : valid f.

Lemma point_positive : 2 <= point f.
Proof using V. destruct V. unfold point. lia. Qed.

Theorem origin_width back o : origin_fits f back o -> is_signed (point f) o.
Proof using V.
  destruct V. unfold origin_fits, mirrored, is_signed, largest_point, point. intros H.
  pose proof (power_positive (finer f) ltac:(lia)). pose proof (power_positive (coord f - 2) ltac:(lia)).
  replace (coord f + finer f - 1) with (coord f - 2 + 1 + finer f) by lia.
  rewrite !power_sum by lia. change (2 ^ 1) with 2. destruct (integer_world f), back; nia.
Qed.

Theorem plane_width p : plane_fits f p -> is_signed (coord f) p.
Proof using V.
  destruct V. unfold plane_fits, is_signed, largest_point. intros H.
  pose proof (power_positive (coord f - 2) ltac:(lia)).
  pose proof (twice_power (coord f - 1) ltac:(lia)) as Twice.
  replace (coord f - 1 - 1) with (coord f - 2) in Twice by lia. destruct (integer_world f); lia.
Qed.

Theorem mantissa_width bound : mantissa_fits f bound -> is_unsigned (mantissa f) bound.
Proof. unfold mantissa_fits, is_unsigned, largest_mantissa. lia. Qed.

Theorem exponent_width e :
  exponent_in_range f e -> is_unsigned (Z.of_nat (Shifter.count_bits (point f))) e.
Proof using V.
  unfold exponent_in_range, is_unsigned, largest_exponent, Shifter.count_bits. intros H.
  pose proof point_positive. pose proof (Z.log2_up_spec (point f) ltac:(lia)).
  rewrite Z2Nat.id by apply Z.log2_up_nonneg. lia.
Qed.

Theorem length_width l : 0 <= l <= largest_length f -> is_signed (coord f + fraction f) l.
Proof using V.
  destruct V. unfold is_signed, largest_length.
  pose proof (power_positive (coord f + fraction f - 1) ltac:(lia)). lia.
Qed.

(* ---- Widths of what is between ---- *)

Lemma difference_fits carry plane o back :
  0 <= carry <= 1 -> plane_fits f plane -> origin_fits f back o ->
  is_signed (point f) (difference f carry plane o back).
Proof using V.
  intro Carry.
  destruct V. unfold plane_fits, origin_fits, difference, mirrored, is_signed, largest_point, point.
  intros Hp Ho.
  pose proof (power_positive (finer f) ltac:(lia)) as Fine.
  replace (coord f + finer f - 1) with (coord f - 2 + 1 + finer f) by lia.
  rewrite !power_sum by lia. change (2 ^ 1) with 2.
  set (G := 2 ^ (coord f - 2)) in *. set (g := 2 ^ finer f) in *.
  replace ((G - 1) * g) with (G * g - g) in Ho by ring.
  replace (G * 2 * g) with (2 * (G * g)) by ring. destruct (integer_world f).
  - assert (Z.abs (plane * g) <= G * g - g) by (rewrite Z.abs_mul; nia). destruct back; lia.
  - assert (Z.abs (plane * g) <= G * g) by (rewrite Z.abs_mul; nia). destruct back; lia.
Qed.

Lemma kept_bits width low v :
  0 <= low < width -> is_signed width v ->
  as_signed (width - low) (slice v (width - 1) low) = v / 2 ^ low /\ is_signed (width - low) (v / 2 ^ low).
Proof.
  intros Hl [Low High]. pose proof (power_positive low ltac:(lia)) as Power.
  assert (is_signed (width - low) (v / 2 ^ low)) as Fits.
  { unfold is_signed. replace (width - 1) with (width - low - 1 + low) in Low, High by lia.
    rewrite power_sum in Low, High by lia.
    split; [apply Z.div_le_lower_bound; lia | apply Z.div_lt_upper_bound; lia]. }
  split; [| exact Fits]. unfold slice. replace (width - 1 - low + 1) with (width - low) by lia.
  exact (resize_same (width - low) _ ltac:(lia) Fits).
Qed.

Lemma on_fine_grid_words_is plane back :
  plane_fits f plane ->
  on_fine_grid_words f plane back = mirrored back (plane * 2 ^ finer f) /\
  is_signed (point f) (mirrored back (plane * 2 ^ finer f)).
Proof using V.
  intros Hp. pose proof point_positive. unfold on_fine_grid_words.
  assert (1 <= finer f \/ finer f = 0) as Finer by (destruct V; lia).
  assert (is_signed (coord f) (mirrored back plane)) as PlaneFits.
  { destruct V. unfold plane_fits, largest_point in Hp. unfold is_signed, mirrored.
    pose proof (twice_power (coord f - 1) ltac:(lia)) as Twice.
    replace (coord f - 1 - 1) with (coord f - 2) in Twice by lia.
    pose proof (power_positive (coord f - 2) ltac:(lia)). destruct (integer_world f), back; lia. }
  assert (as_signed (coord f) (Z.lxor (as_unsigned (coord f) plane) (spread back (coord f))) =
          mirrored back plane) as ->.
  { assert (2 <= coord f) as N by (destruct V; assumption). pose proof (power_positive (coord f) ltac:(lia)).
    rewrite xor_spread by (try apply Z.mod_pos_bound; lia).
    rewrite <- (resize_same (coord f) (mirrored back plane) ltac:(lia) PlaneFits) at 1.
    unfold resize. f_equal. unfold as_unsigned, mirrored. destruct back; [| reflexivity].
    replace (- plane - 1)
      with (2 ^ coord f - 1 - plane mod 2 ^ coord f + (- (plane / 2 ^ coord f) - 1) * 2 ^ coord f)
      by (pose proof (Z.div_mod plane (2 ^ coord f) ltac:(lia)); lia).
    rewrite Z_mod_plus_full. symmetry. apply Z.mod_small.
    pose proof (Z.mod_pos_bound plane (2 ^ coord f)). lia. }
  assert (2 <= coord f) as N by (destruct V; assumption).
  assert (is_signed (point f) (mirrored back (plane * 2 ^ finer f))) as FineFits.
  { pose proof (power_positive (finer f) ltac:(lia)). unfold is_signed, point, mirrored in *.
    replace (coord f + finer f - 1) with (coord f - 1 + finer f) by lia.
    rewrite power_sum by lia. destruct back; nia. }
  split; [| exact FineFits].
  destruct Finer as [Finer | Finer].
  - destruct (Z.ltb_spec 0 (finer f)); [| lia].
    pose proof (power_positive (finer f) ltac:(lia)) as PowerG.
    pose proof (power_positive (coord f) ltac:(lia)) as PowerN.
    rewrite <- (resize_same (point f) _ ltac:(lia) FineFits) at 1. unfold resize. f_equal.
    unfold cat, as_unsigned. set (v := mirrored back plane) in *.
    assert (mirrored back (plane * 2 ^ finer f) = v * 2 ^ finer f + spread back (finer f)) as ->.
    { unfold v, mirrored, spread. destruct back; ring. }
    unfold point. rewrite power_sum by lia.
    pose proof (Z.mod_pos_bound v (2 ^ coord f) ltac:(lia)).
    pose proof (Z.div_mod v (2 ^ coord f) ltac:(lia)) as Division.
    assert (0 <= spread back (finer f) < 2 ^ finer f) by (unfold spread; destruct back; lia).
    replace (v * 2 ^ finer f + spread back (finer f)) with
      (v mod 2 ^ coord f * 2 ^ finer f + spread back (finer f) +
       v / 2 ^ coord f * (2 ^ coord f * 2 ^ finer f))
      by nia.
    rewrite Z_mod_plus_full. symmetry. apply Z.mod_small. nia.
  - rewrite Finer, Z.ltb_irrefl, Z.pow_0_r, Z.mul_1_r. reflexivity.
Qed.

Lemma difference_words_are plane o back :
  plane_fits f plane -> origin_fits f back o ->
  near_difference_words f plane o back = difference f 0 plane o back /\
  far_difference_words f plane o back = difference f 1 plane o back.
Proof using V.
  intros Hp Ho. destruct (on_fine_grid_words_is plane back Hp) as [Fine Fits].
  pose proof point_positive as W. pose proof (origin_width back o Ho) as Origin.
  unfold near_difference_words, far_difference_words. rewrite Fine. split.
  - pose proof (difference_fits 0 plane o back ltac:(lia) Hp Ho) as Fits0. unfold difference in *.
    rewrite Z.add_0_r in *. destruct (integer_world f); apply resize_same; (lia || assumption).
  - pose proof (difference_fits 1 plane o back ltac:(lia) Hp Ho) as Fits1. unfold difference in *.
    destruct (integer_world f); [rewrite sum_with_carry_is by (lia || assumption) |];
      apply resize_same; (lia || assumption).
Qed.

(* The major distance is an arithmetic shift. *)
Lemma major_distance_shift d :
  major_distance f d =
  if fraction f <? finer f then d / 2 ^ (finer f - fraction f) else d * 2 ^ (fraction f - finer f).
Proof.
  unfold major_distance. destruct (Z.ltb_spec (fraction f) (finer f)).
  - rewrite <- floor_of_quotient by lia. apply Qfloor_comp. rewrite <- Qmult_assoc, <- pow2_plus.
    replace (fraction f + - finer f) with (- (finer f - fraction f)) by lia. reflexivity.
  - rewrite <- (Qfloor_Z (d * _)). apply Qfloor_comp. rewrite <- Qmult_assoc, <- pow2_plus.
    rewrite inject_Z_mult, pow2_integer by lia. reflexivity.
Qed.

(* It has a bit less than other distances. *)
Lemma major_distance_fits d :
  is_signed (point f) d -> is_signed (coord f + fraction f) (major_distance f d).
Proof using V.
  intros Hd. rewrite major_distance_shift. destruct V, (Z.ltb_spec (fraction f) (finer f)).
  - replace (coord f + fraction f) with (point f - (finer f - fraction f)) by (unfold point; lia).
    apply (kept_bits (point f)); [unfold point; lia | exact Hd].
  - unfold is_signed, point in *.
    replace (coord f + fraction f - 1) with (coord f + finer f - 1 + (fraction f - finer f)) by lia.
    rewrite power_sum by lia. pose proof (power_positive (fraction f - finer f) ltac:(lia)). nia.
Qed.

Lemma major_distance_words_is d :
  is_signed (point f) d -> major_distance_words f d = major_distance f d.
Proof using V.
  intros Hd. pose proof (major_distance_fits d Hd) as Fits.
  assert (1 <= coord f + fraction f) by (destruct V; lia).
  assert (is_signed (distance f) (major_distance f d)) as Fits'.
  { unfold is_signed, distance in *. rewrite (twice_power (coord f + fraction f + 1 - 1)) by lia.
    replace (coord f + fraction f + 1 - 1 - 1) with (coord f + fraction f - 1) by lia. lia. }
  rewrite <- (resize_same (distance f) (major_distance f d)) at 1; [| unfold distance; lia | exact Fits'].
  unfold major_distance_words. f_equal. rewrite major_distance_shift in *.
  destruct (Z.ltb_spec (fraction f) (finer f)) as [Fewer | More].
  - destruct (Z.ltb_spec (finer f) (fraction f)); [lia |].
    replace (coord f + fraction f) with (point f - (finer f - fraction f)) by (unfold point; lia).
    apply (kept_bits (point f)); [destruct V; unfold point; lia | exact Hd].
  - destruct (Z.ltb_spec (finer f) (fraction f)).
    + rewrite <- (resize_same (coord f + fraction f) _ ltac:(lia) Fits). unfold resize. f_equal.
      unfold cat, as_unsigned.
      replace (coord f + fraction f) with (point f + (fraction f - finer f)) by (unfold point; lia).
      pose proof point_positive. pose proof (power_positive (point f) ltac:(lia)).
      pose proof (power_positive (fraction f - finer f) ltac:(lia)).
      rewrite power_sum, Z.mul_mod_distr_r by lia. lia.
    + replace (fraction f - finer f) with 0 by lia. lia.
Qed.

Lemma shift_fits d e : is_signed (point f) (IntMajor.saturating_shift f d e).
Proof using V.
  pose proof point_positive. pose proof (power_positive (point f - 1) ltac:(lia)).
  unfold is_signed, IntMajor.saturating_shift. lia.
Qed.

Lemma product_fits s bound :
  is_signed (point f) s -> mantissa_fits f bound -> is_signed (point f + mantissa f) (s * bound).
Proof using V.
  intros [Low High] [Positive Bound]. pose proof point_positive. destruct V.
  unfold is_signed, largest_mantissa in *.
  replace (point f + mantissa f - 1) with (point f - 1 + mantissa f) by lia. rewrite power_sum by lia.
  pose proof (power_positive (point f - 1) ltac:(lia)). nia.
Qed.

Lemma scaled_distance_fits d bound e :
  mantissa_fits f bound -> is_signed (distance f) (scaled_distance f d bound e).
Proof using V.
  intros Hb. pose proof point_positive. pose proof (product_fits _ _ (shift_fits d e) Hb) as Fits.
  unfold scaled_distance.
  replace (distance f) with (point f + mantissa f - trimmed f) by (unfold distance, point, trimmed; lia).
  apply (kept_bits (point f + mantissa f)); [destruct V; unfold trimmed, point in *; lia | exact Fits].
Qed.

Lemma scaled_distance_words_is d bound e :
  is_signed (point f) d -> mantissa_fits f bound -> exponent_in_range f e ->
  scaled_distance_words f d bound e = scaled_distance f d bound e.
Proof using V.
  intros Hd Hb He. pose proof point_positive. unfold scaled_distance_words.
  rewrite Shifter.saturating_shift_is_clamp
    by (unfold exponent_in_range, largest_exponent in He; assumption || lia).
  change (Z.max _ _) with (IntMajor.saturating_shift f d e).
  pose proof (product_fits _ _ (shift_fits d e) Hb) as Fits.
  rewrite resize_same by (try exact Fits; destruct V; lia).
  replace (distance f) with (point f + mantissa f - trimmed f) by (unfold distance, point, trimmed; lia).
  apply (kept_bits (point f + mantissa f)); [destruct V; unfold trimmed, point in *; lia | exact Fits].
Qed.

Definition both_signed (d : NearFar Z) : Prop := is_signed (point f) (near d) /\ is_signed (point f) (far d).

Lemma scaled_slab_words_is d floor ceil e :
  both_signed d -> mantissa_fits f floor -> mantissa_fits f ceil -> exponent_in_range f e ->
  scaled_slab_words f d floor ceil e = scaled_slab f d floor ceil e /\
  is_signed (distance f) (far (scaled_slab f d floor ceil e)).
Proof using V.
  intros [Near Far] Floor Ceil Exp. unfold scaled_slab_words, scaled_slab. pose proof point_positive.
  rewrite !sign_is by (assumption || lia). cbn [near far]. split.
  - f_equal; apply scaled_distance_words_is; try assumption.
    + destruct (near d <? 0); assumption.
    + destruct (far d <? 0); assumption.
  - apply scaled_distance_fits. destruct (far d <? 0); assumption.
Qed.

(* The theorem of this file: no modular arithmetic and no mux of the datapath changes the answer. *)
Theorem words_equal_integers ray planes :
  operands_fit f ray planes -> test_words f ray planes = test f ray planes.
Proof using V.
  intros [OM OA OB FA CA FB CB EA EB Len [X0 [X1 [Y0 [Y1 [Z0 Z1]]]]]].
  assert (forall p0 p1 p2, plane_fits f p0 -> plane_fits f p1 -> plane_fits f p2 ->
          plane_fits f (m (to_ray_axes ray p0 p1 p2)) /\ plane_fits f (a (to_ray_axes ray p0 p1 p2)) /\
          plane_fits f (b (to_ray_axes ray p0 p1 p2))) as RayAxis.
  { intros p0 p1 p2 ? ? ?. cbn [to_ray_axes m a b]. destruct (major_y ray), (major_z ray); auto. }
  destruct (RayAxis _ _ _ X0 Y0 Z0) as [LM [LA LB]]. destruct (RayAxis _ _ _ X1 Y1 Z1) as [HM [HA HB]].
  clear RayAxis.
  assert (forall back low high o, plane_fits f low -> plane_fits f high -> origin_fits f back o ->
          let plane := in_ray_order back low high in
          near_difference_words f (near plane) o back = difference f 0 (near plane) o back /\
          far_difference_words f (far plane) o back = difference f 1 (far plane) o back /\
          both_signed {| near := difference f 0 (near plane) o back;
                         far := difference f 1 (far plane) o back |}) as Slab.
  { intros back low high o Low High Origin. cbn [in_ray_order near far].
    assert (plane_fits f (if back then high else low)) by (destruct back; assumption).
    assert (plane_fits f (if back then low else high)) by (destruct back; assumption).
    repeat split; try (apply difference_words_are; assumption); apply difference_fits; assumption || lia. }
  destruct (Slab _ _ _ _ LM HM OM) as [NM [FM SM]]. destruct (Slab _ _ _ _ LA HA OA) as [NA [FarA SA]].
  destruct (Slab _ _ _ _ LB HB OB) as [NB [FarB SB]]. clear Slab.
  unfold test_words, test, test_with, plane_distances_words, plane_distances_with. cbv zeta.
  rewrite NM, FM, NA, FarA, NB, FarB. cbn [near far m a b].
  destruct SM as [SM0 SM1]. cbn [near far] in SM0, SM1. rewrite !major_distance_words_is by assumption.
  destruct (scaled_slab_words_is _ _ _ _ SA FA CA EA) as [-> FitsA].
  destruct (scaled_slab_words_is _ _ _ _ SB FB CB EB) as [-> FitsB].
  pose proof (major_distance_fits _ SM1) as FitsM.
  set (slab_a := scaled_slab _ _ _ _ _) in *. set (slab_b := scaled_slab _ _ _ _ _) in *.
  set (near_m := major_distance _ _). set (far_m := major_distance f _) in *.
  assert (1 <= coord f + fraction f) by (destruct V; assumption).
  assert (forall p q, greater p q = Z.max p q) as Greater.
  { intros. unfold greater. destruct (Z.ltb_spec p q); lia. }
  assert (forall p q, lesser p q = Z.min p q) as Lesser.
  { intros. unfold lesser. destruct (Z.ltb_spec q p); lia. }
  rewrite !Greater, !Lesser. rewrite sign_is.
  - rewrite <- !Z.leb_antisym. reflexivity.
  - unfold distance. lia.
  - unfold is_signed, distance in *.
    pose proof (twice_power (coord f + fraction f + 1 - 1) ltac:(lia)) as Twice.
    replace (coord f + fraction f + 1 - 1 - 1) with (coord f + fraction f - 1) in Twice by lia. lia.
Qed.
End Widths.
