(* The signs of five integers say exactly whether the ray has a point in the closed triangle, and such a hit lies
   in boxes that the unit accepts. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor NeverMisses IntegerWorld Ranges IntegerTriangle Triangle.
Open Scope Z_scope.

(* e is zero or has the sign of d. *)
Definition agrees_in_sign (d e : Z) : Prop := e = 0 \/ Z.sgn e = Z.sgn d.

Record hit_criterion (g : Z) (t : Corners) (o d : Vector) : Prop := {
  not_parallel : det t d <> 0;
  e0_agrees : agrees_in_sign (det t d) (e0 g t o d);
  u_agrees : agrees_in_sign (det t d) (- u g t o d);
  v_agrees : agrees_in_sign (det t d) (- v g t o d);
  num_agrees : agrees_in_sign (det t d) (- num g t o)
}.

Lemma agreement d e : d <> 0 -> agrees_in_sign d e <-> 0 <= d * e.
Proof.
  unfold agrees_in_sign. intro.
  destruct (Z.sgn_spec d) as [[? ->] | [[? ->] | [? ->]]], (Z.sgn_spec e) as [[? ->] | [[? ->] | [? ->]]]; nia.
Qed.

Lemma ratio_not_negative d e : d <> 0 -> 0 <= d * e -> (0 <= inject_Z e / inject_Z d)%Q.
Proof.
  intros NotZero Product. destruct (Z_lt_ge_dec 0 d) as [Positive | Negative].
  - assert (0 <= e) as E by nia. rewrite Zle_Qle in E. rewrite Zlt_Qlt in Positive.
    change (inject_Z 0) with 0%Q in *. apply Qle_shift_div_l; lra.
  - assert (0 <= - e /\ 0 < - d) as [E D] by nia. rewrite Zle_Qle, inject_Z_opp in E.
    rewrite Zlt_Qlt, inject_Z_opp in D. change (inject_Z 0) with 0%Q in *.
    setoid_replace (inject_Z e / inject_Z d)%Q with (- inject_Z e / - inject_Z d)%Q by (field; lra).
    apply Qle_shift_div_l; lra.
Qed.

Lemma product_not_negative d e w :
  (0 <= w)%Q -> (inject_Z e == w * inject_Z d)%Q -> 0 <= d * e.
Proof.
  intros W Is. rewrite Zle_Qle, inject_Z_mult, Is. change (inject_Z 0) with 0%Q.
  setoid_replace (inject_Z d * (w * inject_Z d))%Q with (w * (inject_Z d * inject_Z d))%Q by ring.
  apply Qmult_le_0_compat; [exact W |]. destruct (Qlt_le_dec (inject_Z d) 0); nra.
Qed.

(* How far the ray has moved along the major axis. *)
Definition hit_distance f (t : Corners) (o d : Vector) : Q :=
  inject_Z (- num (finer f) t o) / inject_Z (det t d) * pow2 (slope f).

Section Hit.
Variables (f : Format) (ray : IntegerRay) (t : Corners).
Hypotheses (V : valid f) (Slope : 0 <= slope f).

Let g := finer f.
Let o := start ray.
Let d := step_of ray.

Lemma fine_is : (inject_Z (2 ^ g) == pow2 g)%Q.
Proof using V. apply pow2_integer. destruct V. assumption. Qed.

(* What a hit says of the numbers, by the weights and the distance. *)
Lemma hit_gives_numbers T w0 w1 w2 :
  (w0 + w1 + w2 == 1)%Q ->
  (forall k, point_at f ray T k ==
     pow2 g * (w0 * inject_Z (corner0 t k) + w1 * inject_Z (corner1 t k) + w2 * inject_Z (corner2 t k)))%Q ->
  (inject_Z (- u g t o d) == pow2 g * w1 * inject_Z (det t d))%Q /\
  (inject_Z (- v g t o d) == pow2 g * w2 * inject_Z (det t d))%Q /\
  (inject_Z (e0 g t o d) == pow2 g * w0 * inject_Z (det t d))%Q /\
  (inject_Z (- num g t o) == T * pow2 (- slope f) * inject_Z (det t d))%Q.
Proof using V.
  intros Sum Point.
  assert (forall k, inject_Z (o k) ==
             pow2 g * (w0 * inject_Z (corner0 t k) + w1 * inject_Z (corner1 t k) + w2 * inject_Z (corner2 t k)) -
             T * pow2 (- slope f) * inject_Z (d k))%Q as Origin.
  { intro k. rewrite <- (Point k). unfold point_at. fold o d. ring. }
  assert (w0 == 1 - w1 - w2)%Q as W0 by lra.
  pose proof (Origin x) as Ox. pose proof (Origin y) as Oy. pose proof (Origin z) as Oz.
  rewrite W0 in Ox, Oy, Oz. rewrite W0. clear Point Origin W0 Sum.
  unfold e0, num, v, u, det, aside, across, to_corner0, fine_corner, edge1, edge2, minus, dot. cbn [cross].
  repeat first [rewrite inject_minus | rewrite inject_Z_opp | rewrite inject_Z_plus | rewrite inject_Z_mult].
  rewrite fine_is, Ox, Oy, Oz. repeat split; ring.
Qed.

Lemma criterion_gives_hit :
  hit_criterion g t o d -> hits_triangle f ray t (hit_distance f t o d).
Proof using V Slope.
  intros [NotZero E U W N]. apply agreement in E, U, W, N; try exact NotZero.
  assert (~ inject_Z (det t d) == 0)%Q as Divisor.
  { change 0%Q with (inject_Z 0). rewrite inject_Z_injective. exact NotZero. }
  pose proof (pow2_positive (slope f)) as PowerS. pose proof (pow2_positive (- g)) as PowerG.
  split.
  { unfold hit_distance. apply Qmult_le_0_compat; [| lra]. apply ratio_not_negative; assumption. }
  exists (inject_Z (e0 g t o d) / inject_Z (det t d) * pow2 (- g))%Q.
  exists (inject_Z (- u g t o d) / inject_Z (det t d) * pow2 (- g))%Q.
  exists (inject_Z (- v g t o d) / inject_Z (det t d) * pow2 (- g))%Q.
  pose proof (pow2_cancel g) as CancelG. pose proof (pow2_cancel (slope f)) as CancelS.
  assert (inject_Z (e0 g t o d) ==
          pow2 g * inject_Z (det t d) + inject_Z (u g t o d) + inject_Z (v g t o d))%Q as E0.
  { unfold e0. rewrite !inject_Z_plus, inject_Z_mult, fine_is. reflexivity. }
  split; [| split; [| split; [| split]]];
    try (apply Qmult_le_0_compat; [| lra]; apply ratio_not_negative; assumption).
  - rewrite E0, !inject_Z_opp.
    setoid_replace ((pow2 g * inject_Z (det t d) + inject_Z (u g t o d) + inject_Z (v g t o d)) /
                    inject_Z (det t d) * pow2 (- g) + - inject_Z (u g t o d) / inject_Z (det t d) * pow2 (- g) +
                    - inject_Z (v g t o d) / inject_Z (det t d) * pow2 (- g))%Q
      with (pow2 g * pow2 (- g))%Q by (field; exact Divisor).
    exact CancelG.
  - intro k. pose proof (to_corner0_is g t o d k) as Way. apply inject_Z_injective in Way.
    unfold to_corner0, fine_corner, edge1, edge2, minus in Way.
    repeat first [rewrite inject_minus in Way | rewrite inject_Z_plus in Way | rewrite inject_Z_mult in Way].
    rewrite fine_is in Way. rewrite E0, !inject_Z_opp. unfold point_at, hit_distance. fold g o d.
    rewrite inject_Z_opp. clear E0 E U W N.
    set (D := inject_Z (det t d)) in *. set (N := inject_Z (num g t o)) in *.
    set (U := inject_Z (u g t o d)) in *. set (W := inject_Z (v g t o d)) in *.
    set (c0 := inject_Z (corner0 t k)) in *. set (c1 := inject_Z (corner1 t k)) in *.
    set (c2 := inject_Z (corner2 t k)) in *. set (dk := inject_Z (d k)) in *. set (ok := inject_Z (o k)) in *.
    setoid_replace (ok + - N / D * pow2 (slope f) * (dk * pow2 (- slope f)))%Q
      with (ok - N / D * dk * (pow2 (slope f) * pow2 (- slope f)))%Q by (field; exact Divisor).
    setoid_replace (pow2 g * ((pow2 g * D + U + W) / D * pow2 (- g) * c0 + - U / D * pow2 (- g) * c1 +
                              - W / D * pow2 (- g) * c2))%Q
      with (((pow2 g * D + U + W) * c0 - U * c1 - W * c2) / D * (pow2 g * pow2 (- g)))%Q
      by (field; exact Divisor).
    rewrite CancelG, CancelS, !Qmult_1_r. apply (Qmult_inj_r _ _ D Divisor).
    setoid_replace ((ok - N / D * dk) * D)%Q with (ok * D - N * dk)%Q by (field; exact Divisor).
    setoid_replace (((pow2 g * D + U + W) * c0 - U * c1 - W * c2) / D * D)%Q
      with ((pow2 g * D + U + W) * c0 - U * c1 - W * c2)%Q by (field; exact Divisor).
    lra.
Qed.

(* The signs decide the hit of a triangle that is not parallel to the ray. *)
Theorem criterion_is_hit :
  hit_criterion g t o d <-> det t d <> 0 /\ exists T, hits_triangle f ray t T.
Proof using V Slope.
  split.
  - intro Criterion. split; [apply (not_parallel _ _ _ _ Criterion) |].
    exists (hit_distance f t o d). apply criterion_gives_hit. exact Criterion.
  - intros [NotZero [T [Start [w0 [w1 [w2 [P0 [P1 [P2 [Sum Point]]]]]]]]]].
    destruct (hit_gives_numbers T w0 w1 w2 Sum Point) as [U [W [E N]]].
    pose proof (pow2_positive g). pose proof (pow2_positive (- slope f)).
    constructor; [exact NotZero | | | |]; apply agreement; try exact NotZero.
    + apply product_not_negative with (pow2 g * w0)%Q; [apply Qmult_le_0_compat; lra | exact E].
    + apply product_not_negative with (pow2 g * w1)%Q; [apply Qmult_le_0_compat; lra | exact U].
    + apply product_not_negative with (pow2 g * w2)%Q; [apply Qmult_le_0_compat; lra | exact W].
    + apply product_not_negative with (T * pow2 (- slope f))%Q; [apply Qmult_le_0_compat; lra | exact N].
Qed.

(* There is one distance. *)
Theorem hit_has_distance T :
  det t d <> 0 -> hits_triangle f ray t T -> (T == hit_distance f t o d)%Q.
Proof using V Slope.
  intros NotZero [_ [w0 [w1 [w2 [_ [_ [_ [Sum Point]]]]]]]].
  destruct (hit_gives_numbers T w0 w1 w2 Sum Point) as [_ [_ [_ N]]].
  assert (~ inject_Z (det t d) == 0)%Q as Divisor.
  { change 0%Q with (inject_Z 0). rewrite inject_Z_injective. exact NotZero. }
  unfold hit_distance. fold g. rewrite N. pose proof (pow2_cancel (slope f)) as Cancel.
  setoid_replace (T * pow2 (- slope f) * inject_Z (det t d) / inject_Z (det t d) * pow2 (slope f))%Q
    with (T * (pow2 (slope f) * pow2 (- slope f)))%Q by (field; exact Divisor).
  rewrite Cancel. ring.
Qed.
End Hit.

(* The numbers of a ray and a triangle that the program takes. *)
Theorem numbers_of_ray_fit f major ray t :
  let o := start ray in
  let d := step_of ray in
  let g := finer f in
  valid f -> 0 <= slope f -> acceptable_integer_ray f major ray ->
  within (largest_point f) (corner0 t) -> within (largest_point f) (corner1 t) ->
  within (largest_point f) (corner2 t) ->
  Z.abs (det t d) < 2 ^ (2 * coord f + slope f) /\
  Z.abs (u g t o d) < 2 ^ (2 * coord f + g + slope f) /\
  Z.abs (v g t o d) < 2 ^ (2 * coord f + g + slope f) /\
  Z.abs (e0 g t o d) < 2 ^ (2 * coord f + g + slope f) /\ Z.abs (num g t o) < 2 ^ (3 * coord f + g - 1).
Proof.
  cbv zeta. intros V Slope RayOk C0 C1 C2. apply numbers_fit; [exact V | exact Slope |]. constructor.
  - auto.
  - intro k. apply (start_in_cube _ _ _ RayOk).
  - intro k. pose proof (slopes_fit _ _ _ RayOk k). unfold step_of. destruct (backward ray k); lia.
Qed.

(* The test in ray axes gives the same: an odd change of axes changes every sign. *)
Definition ray_axis (major : Axis) (k : Axis) : Axis :=
  match k with x => major | y => axis_a major | z => axis_b major end.
Definition vector_in_ray_axes (major : Axis) (p : Vector) : Vector := fun k => p (ray_axis major k).
Definition corners_in_ray_axes (major : Axis) (t : Corners) : Corners :=
  {| corner0 := vector_in_ray_axes major (corner0 t);
     corner1 := vector_in_ray_axes major (corner1 t);
     corner2 := vector_in_ray_axes major (corner2 t) |}.

Theorem criterion_in_ray_axes g major t o d :
  hit_criterion g (corners_in_ray_axes major t) (vector_in_ray_axes major o) (vector_in_ray_axes major d) <->
  hit_criterion g t o d.
Proof.
  set (turned := corners_in_ray_axes major t). set (turned_o := vector_in_ray_axes major o).
  set (turned_d := vector_in_ray_axes major d).
  assert (exists s, (s = 1 \/ s = -1) /\ det turned turned_d = s * det t d /\
          e0 g turned turned_o turned_d = s * e0 g t o d /\ u g turned turned_o turned_d = s * u g t o d /\
          v g turned turned_o turned_d = s * v g t o d /\ num g turned turned_o = s * num g t o)
    as [s [Sign [Det [E [U [W N]]]]]].
  { exists (match major with x => 1 | _ => -1 end). split; [destruct major; auto |].
    unfold e0, num, v, u, det, aside, across, to_corner0, fine_corner, edge1, edge2, minus, dot,
      turned, turned_o, turned_d, corners_in_ray_axes, vector_in_ray_axes.
    destruct major; cbn [cross corner0 corner1 corner2 ray_axis axis_a axis_b];
      set (fine := 2 ^ g); repeat split; ring. }
  split; intros [NotZero EA UA VA NA]; rewrite ?Det, ?E, ?U, ?W, ?N in *;
    (assert (det t d <> 0) by nia);
    (constructor; rewrite ?Det, ?E, ?U, ?W, ?N; [nia | | | |]);
    rewrite agreement in * by nia; destruct Sign as [-> | ->]; lia.
Qed.

(* The headline with the test of the triangle: an exact hit lies in boxes that the datapath accepts. *)
Theorem criterion_hit_is_accepted :
  forall (f : Format) (major : Axis) (ray : IntegerRay) (box : IntegerBox) (t : Corners),
    valid f -> 0 < slope f -> acceptable_integer_ray f major ray -> acceptable_integer_box f box ->
    holds_corners box t -> hit_criterion (finer f) t (start ray) (step_of ray) ->
    as_distance f (hit_distance f t (start ray) (step_of ray)) <= cut ray <= largest_length f ->
    integer_hit_words f major ray box = true.
Proof.
  intros f major ray box t V Integer RayOk BoxOk Corners Criterion Cut.
  apply triangle_hit_is_accepted with t (hit_distance f t (start ray) (step_of ray)); try assumption.
  apply criterion_gives_hit; (assumption || lia).
Qed.
