(* The set-ups give operands in range, so the datapath in words never misses. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor SetUp NeverMisses IntegerWorld Datapath.
Open Scope Z_scope.

Section FloatWorld.
Variable f : Format.
Hypotheses (V : valid f) (Float : slope f = 0).

Lemma origin_word_fits back c : in_cube c -> origin_fits f back (origin_word f back c).
Proof using V Float.
  intros [Low High]. unfold origin_fits, origin_word, mirrored, on_fine_grid. rewrite (in_float_world f Float).
  assert (0 <= finer f) as Finer by (destruct V; assumption).
  pose proof (scale_positive f V) as S. unfold scale in S.
  assert (inject_Z (largest_point f * 2 ^ finer f) == inject_Z (largest_point f) * pow2 (finer f))%Q as Limit
    by (rewrite inject_Z_mult, pow2_integer by lia; reflexivity).
  set (limit := largest_point f * 2 ^ finer f) in *.
  set (s := (inject_Z (largest_point f) * pow2 (finer f))%Q) in *.
  assert (- s <= s * c <= s)%Q as Range by (split; nra). destruct back.
  - assert (- limit <= Qfloor (s * c + (1 # 2)) <= limit); [| lia]. split.
    + apply below_floor. rewrite inject_Z_opp. lra.
    + pose proof (floor_below (s * c + (1 # 2))) as Floor.
      enough (Qfloor (s * c + (1 # 2)) < limit + 1) by lia. rewrite Zlt_Qlt, inject_Z_plus, inject_1. lra.
  - assert (- limit <= Qceiling (s * c - (1 # 2)) <= limit); [| lia]. split.
    + pose proof (ceiling_above (s * c - (1 # 2))) as Ceiling.
      enough (- limit - 1 < Qceiling (s * c - (1 # 2))) by lia.
      rewrite Zlt_Qlt, inject_minus, inject_Z_opp, inject_1. lra.
    + apply above_ceiling. lra.
Qed.

(* Half a unit of the fine grid is at most half a unit of the coarse one. *)
Lemma growth : (0 < pow2 (- (finer f + 1)) <= 1 # 2)%Q.
Proof using V.
  destruct V. split; [apply pow2_positive |].
  pose proof (pow2_negative_below (- finer f) ltac:(lia)).
  replace (- (finer f + 1)) with (- finer f + - (1)) by lia. rewrite pow2_plus.
  setoid_replace (pow2 (- (1))) with (1 # 2)%Q by reflexivity. lra.
Qed.

Lemma lower_fits c : in_cube c -> plane_fits f (lower f c).
Proof using V Float.
  intros [Low High]. unfold plane_fits, lower. rewrite (in_float_world f Float).
  pose proof growth. pose proof (grid_positive f V) as G.
  rewrite Zle_Qle in G. change (inject_Z 0) with 0%Q in G.
  set (p := (inject_Z (largest_point f) * c - pow2 (- (finer f + 1)))%Q).
  assert (- inject_Z (largest_point f) - (1 # 2) <= p <= inject_Z (largest_point f))%Q as Range
    by (unfold p; split; nra).
  assert (- largest_point f - 1 <= Qfloor p <= largest_point f); [| lia]. split.
  - apply below_floor. rewrite inject_minus, inject_Z_opp, inject_1. lra.
  - rewrite Zle_Qle. pose proof (floor_below p). lra.
Qed.

Lemma upper_fits c : in_cube c -> plane_fits f (upper f c).
Proof using V Float.
  intros [Low High]. unfold plane_fits, upper. rewrite (in_float_world f Float).
  pose proof growth. pose proof (grid_positive f V) as G.
  rewrite Zle_Qle in G. change (inject_Z 0) with 0%Q in G.
  set (p := (inject_Z (largest_point f) * c + pow2 (- (finer f + 1)))%Q).
  assert (- inject_Z (largest_point f) <= p <= inject_Z (largest_point f) + (1 # 2))%Q as Range
    by (unfold p; split; nra).
  assert (- largest_point f <= Qceiling p <= largest_point f + 1); [| lia]. split.
  - rewrite Zle_Qle, inject_Z_opp. pose proof (ceiling_above p). lra.
  - apply above_ceiling. rewrite inject_Z_plus, inject_1. lra.
Qed.

Lemma length_fits major l :
  (0 <= major)%Q -> (forall l', l = Some l' -> (0 <= l')%Q) -> 0 <= length_word f major l <= largest_length f.
Proof using V.
  intros Major Length. assert (0 <= largest_length f) as Largest.
  { destruct V. unfold largest_length.
    pose proof (power_positive (coord f + fraction f - 1) ltac:(lia)). lia. }
  destruct l as [l |]; cbn [length_word]; [| lia].
  split; [| lia]. apply Z.min_glb; [| exact Largest]. apply below_floor. change (inject_Z 0) with 0%Q.
  pose proof (grid_positive f V) as G. rewrite Zle_Qle in G. change (inject_Z 0) with 0%Q in G.
  pose proof (pow2_positive (fraction f)). specialize (Length l eq_refl).
  repeat apply Qmult_le_0_compat; try assumption. lra.
Qed.

Theorem set_up_fits major ray box :
  is_major major ray -> acceptable_ray ray -> acceptable_box box ->
  operands_fit f (set_up f major ray) (quantise_box f box).
Proof using V Float.
  intros Major [Origin Length] BoxOk.
  assert (forall k, quotient_bounds f (Qabs (direction ray major)) (Qabs (direction ray k))
            (quotient f (largest_exponent f) (Qabs (direction ray major)) (Qabs (direction ray k))))
    as Bounds.
  { intro k. apply quotient_has_bounds; [exact V | apply Qabs_nonneg | apply Major]. }
  assert (1 <= mantissa f) as Hp by (destruct V; assumption).
  pose proof (power_positive (mantissa f - 1) ltac:(lia)) as Power.
  constructor;
    cbn [set_up set_up_to back_m back_a back_b origin_m origin_a origin_b floor_a ceil_a floor_b ceil_b
         exp_a exp_b len quantise_box xmin xmax ymin ymax zmin zmax].
  1-3: apply origin_word_fits, Origin.
  1-6: destruct (Bounds (axis_a major)) as [LA HA EA _], (Bounds (axis_b major)) as [LB HB EB _].
  1-6: unfold mantissa_fits, exponent_in_range; lia.
  - apply length_fits; [apply Qabs_nonneg | exact Length].
  - repeat split; (apply lower_fits || apply upper_fits); apply BoxOk.
Qed.
End FloatWorld.

(* What the Verilog computes: the datapath in words, on the operands of the set-up. *)
Definition hit_words f (major : Axis) (ray : Ray) (box : Box) : bool :=
  test_words f (set_up f major ray) (quantise_box f box).

Theorem datapath_equals_unit :
  forall (f : Format) (major : Axis) (ray : Ray) (box : Box),
    valid f -> slope f = 0 -> is_major major ray -> acceptable_ray ray -> acceptable_box box ->
    hit_words f major ray box = hit f major ray box.
Proof.
  intros. unfold hit_words, hit. apply words_equal_integers; [assumption |]. apply set_up_fits; assumption.
Qed.

Theorem datapath_never_misses :
  forall (f : Format) (major : Axis) (ray : Ray) (box : Box),
    valid f -> slope f = 0 -> is_major major ray -> acceptable_ray ray -> acceptable_box box ->
    meets ray box -> hit_words f major ray box = true.
Proof. intros. rewrite datapath_equals_unit by assumption. apply never_misses; assumption. Qed.

(* ---- The integer world ---- *)

Theorem integer_set_up_fits f major ray box :
  valid f -> 0 < slope f -> acceptable_integer_ray f major ray -> acceptable_integer_box f box ->
  0 <= cut ray <= largest_length f ->
  operands_fit f (integer_set_up f major ray) (integer_planes box).
Proof.
  intros V Integer RayOk BoxOk Cut.
  pose proof (in_integer_world f Integer) as World.
  pose proof (fun k => slope_quotient_has_bounds f (slopes ray k) V Integer (slopes_fit _ _ _ RayOk k))
    as Bounds.
  assert (1 <= mantissa f) as Hp by (destruct V; assumption).
  pose proof (power_positive (mantissa f - 1) ltac:(lia)) as Power.
  constructor;
    cbn [integer_set_up back_m back_a back_b origin_m origin_a origin_b floor_a ceil_a floor_b ceil_b
         exp_a exp_b len integer_planes xmin xmax ymin ymax zmin zmax].
  1-3: unfold origin_fits, negated_origin; rewrite World.
  1: pose proof (start_in_cube _ _ _ RayOk major); destruct (backward ray major); lia.
  1: pose proof (start_in_cube _ _ _ RayOk (axis_a major)); destruct (backward ray (axis_a major)); lia.
  1: pose proof (start_in_cube _ _ _ RayOk (axis_b major)); destruct (backward ray (axis_b major)); lia.
  1-6: destruct (Bounds (axis_a major)) as [LA HA EA _], (Bounds (axis_b major)) as [LB HB EB _].
  1-6: unfold mantissa_fits, exponent_in_range; lia.
  - exact Cut.
  - unfold plane_fits. rewrite World. repeat split; apply BoxOk.
Qed.

(* What the Verilog computes of an integer ray. *)
Definition integer_hit_words f (major : Axis) (ray : IntegerRay) (box : IntegerBox) : bool :=
  test_words f (integer_set_up f major ray) (integer_planes box).

Theorem datapath_accepts_integer_hit :
  forall (f : Format) (major : Axis) (ray : IntegerRay) (box : IntegerBox) (T : Q),
    valid f -> 0 < slope f -> acceptable_integer_ray f major ray -> acceptable_integer_box f box ->
    (0 <= T)%Q -> holds_point f box (point_at f ray T) -> as_distance f T <= cut ray <= largest_length f ->
    integer_hit_words f major ray box = true.
Proof.
  intros f major ray box T V Integer RayOk BoxOk Start Inside Cut. unfold integer_hit_words.
  pose proof (as_distance_not_negative f T Start).
  rewrite words_equal_integers; [| exact V | apply integer_set_up_fits; assumption || lia].
  apply (integer_hit_is_accepted f major ray box T); assumption || lia.
Qed.
