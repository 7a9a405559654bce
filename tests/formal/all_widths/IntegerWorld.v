(* The integer world: corners, origins and slopes of rays are integers, and boxes do not grow. The unit accepts
   every box that holds a point of the ray, up to the cut. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor SetUp NeverMisses.
Open Scope Z_scope.

(* The origin is in units of 2^-g of a corner's unit. The direction's component is +-slopes k in units of
   2^-S of the major one. The cut is the largest distance that the unit accepts. *)
Record IntegerRay := {
  start : Axis -> Z;
  backward : Axis -> bool;
  slopes : Axis -> Z;
  cut : Z
}.

(* Faces in units of a corner. *)
Record IntegerBox := { lo_face : Axis -> Z; hi_face : Axis -> Z }.

Record acceptable_integer_ray f (major : Axis) (ray : IntegerRay) : Prop := {
  start_in_cube : forall k, Z.abs (start ray k) <= largest_point f * 2 ^ finer f;
  major_slope : slopes ray major = 2 ^ slope f;
  slopes_fit : forall k, 0 <= slopes ray k <= 2 ^ slope f
}.

Definition acceptable_integer_box f (box : IntegerBox) : Prop :=
  forall k, Z.abs (lo_face box k) <= largest_point f /\ Z.abs (hi_face box k) <= largest_point f.

Definition step_of (ray : IntegerRay) (k : Axis) : Z := if backward ray k then - slopes ray k else slopes ray k.

(* The point of the ray where it has moved T along the major axis, in units of the fine grid. *)
Definition point_at f (ray : IntegerRay) (T : Q) (k : Axis) : Q :=
  inject_Z (start ray k) + T * (inject_Z (step_of ray k) * pow2 (- slope f)).

Definition holds_point f (box : IntegerBox) (point : Axis -> Q) : Prop :=
  forall k, (inject_Z (lo_face box k * 2 ^ finer f) <= point k <= inject_Z (hi_face box k * 2 ^ finer f))%Q.

(* ---- The operands ---- *)

(* -x, or x + 1 where the direction is negative. *)
Definition negated_origin (back : bool) (o : Z) : Z := if back then o + 1 else - o.

(* A slope of 0 has fixed mantissas. *)
Definition slope_quotient f (s : Z) : MajorQuotient :=
  if s =? 0
  then {| mantissa_low := 2 ^ (mantissa f - 1); mantissa_high := 2 ^ (mantissa f - 1);
          exponent := largest_exponent f |}
  else quotient f (largest_exponent f) (inject_Z (2 ^ slope f)) (inject_Z s).

Definition integer_set_up f (major : Axis) (ray : IntegerRay) : MajorRay :=
  let back := backward ray in
  let word k := negated_origin (back k) (start ray k) in
  let q k := slope_quotient f (slopes ray k) in
  let a := axis_a major in
  let b := axis_b major in
  {| major_y := match major with y => true | _ => false end;
     major_z := match major with z => true | _ => false end;
     back_m := back major; back_a := back a; back_b := back b;
     origin_m := word major; origin_a := word a; origin_b := word b;
     floor_a := mantissa_low (q a); ceil_a := mantissa_high (q a);
     floor_b := mantissa_low (q b); ceil_b := mantissa_high (q b);
     exp_a := exponent (q a); exp_b := exponent (q b);
     len := cut ray |}.

Definition integer_planes (box : IntegerBox) : MajorPlanes :=
  {| xmin := lo_face box x; xmax := hi_face box x;
     ymin := lo_face box y; ymax := hi_face box y;
     zmin := lo_face box z; zmax := hi_face box z |}.

Definition integer_hit f (major : Axis) (ray : IntegerRay) (box : IntegerBox) : bool :=
  test f (integer_set_up f major ray) (integer_planes box).

(* ---- What the proof takes from them ---- *)

Theorem slope_quotient_has_bounds f s :
  valid f -> 0 < slope f -> 0 <= s <= 2 ^ slope f ->
  quotient_bounds f (inject_Z (2 ^ slope f)) (inject_Z s) (slope_quotient f s).
Proof.
  intros V Integer [Low High]. unfold slope_quotient. destruct (Z.eqb_spec s 0) as [-> | NotZero].
  - destruct V. pose proof (power_positive (mantissa f - 1) ltac:(lia)).
    pose proof (largest_mantissa_is f ltac:(lia)). pose proof (power_positive (slope f) ltac:(lia)) as Slope.
    constructor; cbn [mantissa_low mantissa_high exponent];
      [lia | lia | unfold largest_exponent, point; lia | right]. split; [reflexivity |].
    rewrite Zlt_Qlt in Slope. pose proof (pow2_positive (mantissa f - 1)).
    change (inject_Z 0) with 0%Q in *. nra.
  - apply quotient_has_bounds; [exact V | |]; [change 0%Q with (inject_Z 0) |]; rewrite <- Zle_Qle; lia.
Qed.

(* The near difference is exact, the far one is 1 more. *)
Lemma integer_differences f o back low high :
  0 < slope f ->
  let plane := in_ray_order back low high in
  let word := negated_origin back o in
  let towards v := if back then o - v * 2 ^ finer f else v * 2 ^ finer f - o in
  difference f 0 (near plane) word back = towards (near plane) /\
  difference f 1 (far plane) word back = towards (far plane) + 1.
Proof.
  intro Integer. unfold difference, mirrored, negated_origin. rewrite (in_integer_world f Integer).
  destruct back; cbn [near far in_ray_order]; lia.
Qed.

Section Slabs.
Variables (f : Format) (major : Axis) (ray : IntegerRay) (box : IntegerBox) (T : Q).
Hypothesis (V : valid f) (Integer : 0 < slope f).
Hypothesis (RayOk : acceptable_integer_ray f major ray) (BoxOk : acceptable_integer_box f box).
Hypothesis (Start : (0 <= T)%Q) (Inside : holds_point f box (point_at f ray T)).

Let moved k := (T * (inject_Z (slopes ray k) * pow2 (- slope f)))%Q.

Lemma moved_along_major : (moved major == T)%Q.
Proof using RayOk Integer.
  unfold moved. rewrite (major_slope _ _ _ RayOk), pow2_integer, pow2_cancel by lia. ring.
Qed.

Let plane k := in_ray_order (backward ray k) (lo_face box k) (hi_face box k).
Let word k := negated_origin (backward ray k) (start ray k).
Let d k := {| near := difference f 0 (near (plane k)) (word k) (backward ray k);
             far := difference f 1 (far (plane k)) (word k) (backward ray k) |}.
Let q k := slope_quotient f (slopes ray k).

Lemma differences_hold k : (inject_Z (near (d k)) <= moved k < inject_Z (far (d k)))%Q.
Proof using Integer Inside.
  destruct (integer_differences f (start ray k) (backward ray k) (lo_face box k) (hi_face box k) Integer)
    as [Near Far].
  unfold d, plane, word. cbn [near far]. cbn [near far] in Near, Far. rewrite Near, Far. clear Near Far.
  destruct (Inside k) as [Low High]. unfold point_at, step_of in Low, High. fold (moved k) in Low, High.
  destruct (backward ray k); cbn [near far in_ray_order]; rewrite inject_Z_plus, !inject_minus, inject_1.
  - rewrite inject_Z_opp in Low, High. unfold moved. split; lra.
  - unfold moved. split; lra.
Qed.

(* Origin and point are in the cube, so they are at most 2 apart. *)
Lemma integer_T_in_cube : (T <= 2 * scale f)%Q.
Proof using All.
  pose proof moved_along_major as Moved. unfold moved in Moved.
  assert (scale f == inject_Z (largest_point f * 2 ^ finer f))%Q as Scale.
  { destruct V. unfold scale. rewrite inject_Z_mult, pow2_integer by lia. reflexivity. }
  rewrite Scale. clear Scale. pose proof (start_in_cube _ _ _ RayOk major) as O.
  destruct (BoxOk major) as [L H]. pose proof (power_positive (finer f) ltac:(destruct V; lia)) as Fine.
  set (limit := largest_point f * 2 ^ finer f) in *.
  assert (- limit <= lo_face box major * 2 ^ finer f /\ hi_face box major * 2 ^ finer f <= limit)
    as [L0 H1] by (unfold limit; nia).
  assert (- limit <= start ray major <= limit) as [O0 O1] by lia.
  rewrite Zle_Qle in L0, H1, O0, O1. rewrite inject_Z_opp in L0, O0.
  destruct (Inside major) as [Low High]. unfold point_at, step_of in Low, High.
  destruct (backward ray major).
  - rewrite inject_Z_opp in Low, High. lra.
  - lra.
Qed.

Lemma integer_T_below_largest : (T <= pow2 (largest_exponent f) - 1)%Q.
Proof using All.
  pose proof integer_T_in_cube as H. rewrite scale_is in H by exact V. destruct V.
  pose proof (pow2_at_least_1 (finer f) ltac:(lia)). lra.
Qed.

Lemma integer_other_slab k :
  let slab := scaled_slab f (d k) (mantissa_low (q k)) (mantissa_high (q k)) (exponent (q k)) in
  near slab <= as_distance f T <= far slab.
Proof using All.
  pose proof (slopes_fit _ _ _ RayOk k) as Fits. pose proof (pow2_positive (- slope f)) as Unit.
  pose proof (slope_quotient_has_bounds f (slopes ray k) V Integer Fits) as Bounds.
  assert (0 <= inject_Z (slopes ray k))%Q as Positive.
  { change 0%Q with (inject_Z 0). rewrite <- Zle_Qle. lia. }
  assert (0 <= inject_Z (2 ^ slope f))%Q as MajorPositive.
  { change 0%Q with (inject_Z 0). rewrite <- Zle_Qle. lia. }
  pose proof integer_T_below_largest.
  apply (slab_holds f (inject_Z (2 ^ slope f)) (inject_Z (slopes ray k)) (q k) (moved k)); try assumption.
  - unfold moved. rewrite pow2_integer by lia. pose proof (pow2_cancel (slope f)) as Cancel.
    setoid_replace (T * (inject_Z (slopes ray k) * pow2 (- slope f)) * pow2 (slope f))%Q
      with (T * inject_Z (slopes ray k) * (pow2 (slope f) * pow2 (- slope f)))%Q by ring.
    rewrite Cancel. ring.
  - unfold moved. apply Qmult_le_0_compat; [assumption |]. apply Qmult_le_0_compat; lra.
  - intro Zero. unfold moved. rewrite Zero. ring.
  - apply differences_hold.
Qed.

Lemma integer_major_slab :
  major_distance f (near (d major)) <= as_distance f T <= major_distance f (far (d major)).
Proof using All.
  apply major_slab_holds. pose proof (differences_hold major). rewrite moved_along_major in *. assumption.
Qed.

Local Opaque major_distance scaled_slab difference slope_quotient.

Lemma integer_slabs_hold :
  slabs_hold f (integer_set_up f major ray) (integer_planes box) (as_distance f T).
Proof using All.
  pose proof integer_major_slab as InM. pose proof (integer_other_slab (axis_a major)) as InA.
  pose proof (integer_other_slab (axis_b major)) as InB. unfold d, plane, word in *.
  destruct major; repeat split; try apply InM; try apply InA; apply InB.
Qed.
End Slabs.

(* The unit accepts, and floor(T 2^(F-g)) lies between the largest near and the smallest far distance. *)
Theorem integer_hit_is_accepted :
  forall (f : Format) (major : Axis) (ray : IntegerRay) (box : IntegerBox) (T : Q),
    valid f -> 0 < slope f -> acceptable_integer_ray f major ray -> acceptable_integer_box f box ->
    (0 <= T)%Q -> holds_point f box (point_at f ray T) -> as_distance f T <= cut ray ->
    integer_hit f major ray box = true /\
    slabs_hold f (integer_set_up f major ray) (integer_planes box) (as_distance f T).
Proof.
  intros f major ray box T V Integer RayOk BoxOk Start Inside Cut.
  pose proof (integer_slabs_hold f major ray box T V Integer RayOk BoxOk Start Inside) as Slabs.
  split; [| exact Slabs]. apply test_accepts with (as_distance f T); [exact Slabs |].
  split; [apply as_distance_not_negative; exact Start | exact Cut].
Qed.
