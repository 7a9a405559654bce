(* Exactly once, for a ray of the integer world, in the numbers of the exact triangle test.

   The line of the ray is seen in ray axes: the major axis first, then the unit's slots a and b, and forward along
   the major axis. So the rule of Crossing.v needs no number that the unit does not have, but one component of
   D x E1. `unit_rule` is the rule as the unit computes it, and `unit_rule_is_crosses` says that it is that rule.
   What it takes is a hit of Triangle.v and TriangleHit.v, if it is ahead; what is hit strictly inside, it takes.
   CrossingMesh.v then counts: the whole line of the ray crosses every closed mesh an even number of times. *)
From Coq Require Import ZArith Lia Bool List.
From HitpipeMajor Require Import Numbers IntMajor NeverMisses IntegerWorld IntegerTriangle Triangle TriangleHit.
From HitpipeMajor Require Crossing CrossingMesh SharedEdge.
Import ListNotations.
Open Scope Z_scope.

(* ---- The rule for a line ---- *)

(* In ray axes x is the major axis, y is a and z is b. Origin o is on the fine grid; d is not 0 along x. *)
Section Line.
Variables (g : Z) (t : Corners) (o d : Vector).

(* A corner as seen along the line: moved along it into the plane of a and b. *)
Definition seen (corner : Vector) : Crossing.Place :=
  let c := fine_corner g o corner in
  {| Crossing.A := d x * c y - d y * c x; Crossing.B := d x * c z - d z * c x |}.

Let c0 := seen (corner0 t).
Let c1 := seen (corner1 t).
Let c2 := seen (corner2 t).

Definition line_crosses : bool := Crossing.crosses c0 c1 c2.

Ltac polynomial :=
  unfold Crossing.det, Crossing.edge, c0, c1, c2, seen, e0, num, v, u, det, aside, across, to_corner0, fine_corner,
    edge1, edge2, minus, dot; cbn [cross Crossing.A Crossing.B]; set (fine := 2 ^ g); ring.

(* The rule's determinants are those of the triangle test, all times numbers of one sign. *)
Theorem edges_seen :
  Crossing.edge c1 c2 = - (d x * 2 ^ g) * e0 g t o d /\
  Crossing.edge c2 c0 = - (d x * 2 ^ g) * - u g t o d /\
  Crossing.edge c0 c1 = - (d x * 2 ^ g) * - v g t o d /\
  Crossing.det c0 c1 c2 = - (d x * 2 ^ g * 2 ^ g) * det t d.
Proof using. repeat split; polynomial. Qed.

(* ---- The rule in the unit ---- *)

(* Vectors P = D x E2, which the unit has, and R = D x E1, of which it needs the component along a. *)
Definition P : Vector := across t d.
Definition R : Vector := cross d (edge1 t).

Definition has_sign (n : Z) (negative : bool) : bool := (n =? 0) || eqb (n <? 0) negative.

Definition ok_u (back : bool) : bool := if P y =? 0 then R y <? 0 else eqb (P y <? 0) back.
Definition ok_v (back : bool) : bool := if R y =? 0 then P y <? 0 else negb (eqb (R y <? 0) back).
Definition ok_0 (back : bool) : bool := if R y - P y =? 0 then 0 <? P y else eqb (R y - P y <? 0) back.

(* The closed test of the three edges, and the rule where one is passed exactly. *)
Definition unit_rule : bool :=
  let back := det t d <? 0 in
  let edge_0 := e0 g t o d in
  let edge_u := u g t o d in
  let edge_v := v g t o d in
  negb (det t d =? 0) &&
  (has_sign edge_0 back && (negb (edge_0 =? 0) || ok_0 back)) &&
  (has_sign edge_u (negb back) && (negb (edge_u =? 0) || ok_u back)) &&
  (has_sign edge_v (negb back) && (negb (edge_v =? 0) || ok_v back)).

(* The product of P and R is along D, so det says what a second component would say. *)
Lemma det_by_components : d x * det t d = R z * P y - R y * P z.
Proof using. unfold R, P, det, across, edge1, edge2, minus, dot. cbn [cross]. ring. Qed.

(* Differences of places are these components. *)
Lemma differences_seen :
  (Crossing.B c2 - Crossing.B c0 = 2 ^ g * - P y /\ Crossing.A c0 - Crossing.A c2 = 2 ^ g * - P z) /\
  (Crossing.B c0 - Crossing.B c1 = 2 ^ g * R y /\ Crossing.A c1 - Crossing.A c0 = 2 ^ g * R z) /\
  (Crossing.B c1 - Crossing.B c2 = 2 ^ g * (P y - R y) /\ Crossing.A c2 - Crossing.A c1 = 2 ^ g * (P z - R z)).
Proof using. unfold R, P. repeat split; polynomial. Qed.
End Line.

Definition first_sign (e b a : Z) : Z := Z.sgn (Crossing.first_not_zero e b a).

(* A factor above 0 changes no sign. *)
Lemma first_sign_of_multiple k l e b a :
  0 < k -> 0 < l -> first_sign (- k * e) (l * b) (l * a) = first_sign (- e) b a.
Proof.
  intros K L. unfold first_sign, Crossing.first_not_zero.
  destruct (Z.eqb_spec (- k * e) 0), (Z.eqb_spec (- e) 0); try nia.
  destruct (Z.eqb_spec (l * b) 0), (Z.eqb_spec b 0); nia.
Qed.

(* One edge: its determinant e, with the sign of det wanted; component b; component a by way of det. *)
Lemma edge_rule e b a D back :
  D <> 0 -> back = (D <? 0) ->
  (first_sign (- e) b a =? Z.sgn (- D)) =
  has_sign e back && (negb (e =? 0) || (if b =? 0 then Z.sgn a =? Z.sgn (- D) else eqb (0 <? b) back)).
Proof.
  intros NotZero ->. unfold first_sign, Crossing.first_not_zero, has_sign.
  destruct (Z.ltb_spec D 0), (Z.ltb_spec e 0), (Z.eqb_spec e 0), (Z.eqb_spec (- e) 0), (Z.eqb_spec b 0),
    (Z.ltb_spec 0 b); cbn; try lia;
    match goal with |- (?s =? ?r) = _ => destruct (Z.eqb_spec s r) end; try reflexivity; try lia;
    destruct (Z.eqb_spec (Z.sgn a) (Z.sgn (- D))); (reflexivity || lia).
Qed.

Lemma sign_of_negative e negative : has_sign (- e) negative = has_sign e (negb negative).
Proof. unfold has_sign. destruct negative, (Z.ltb_spec e 0), (Z.ltb_spec (- e) 0), (Z.eqb_spec e 0); lia. Qed.

Lemma negative_is_0 e : (- e =? 0) = (e =? 0).
Proof. lia. Qed.

(* Where component a is 0, det has the sign of a product, so its sign says what component b's sign is. *)
Ltac decide_signs :=
  repeat match goal with
  | |- context [?m =? 0] => destruct (Z.eqb_spec m 0)
  | |- context [?m <? 0] => destruct (Z.ltb_spec m 0)
  | |- context [0 <? ?m] => destruct (Z.ltb_spec 0 m)
  | |- context [Z.sgn ?m =? Z.sgn ?n] => destruct (Z.eqb_spec (Z.sgn m) (Z.sgn n))
  end; cbn; try reflexivity; try lia; nia.

(* The headline of this part: the unit's rule is the rule of the moved line. *)
Theorem unit_rule_is_crosses g t o d : 0 <= g -> 0 < d x -> unit_rule g t o d = line_crosses g t o d.
Proof.
  intros G Forward. pose proof (power_positive g G) as Fine.
  destruct (edges_seen g t o d) as [E0 [Eu [Ev Det]]].
  destruct (differences_seen g t o d) as [[Bu Au] [[Bv Av] [B0 A0]]].
  pose proof (det_by_components t d) as Components.
  unfold unit_rule, line_crosses, Crossing.crosses, Crossing.side. rewrite E0, Eu, Ev, Bu, Au, Bv, Av, B0, A0, Det.
  fold (first_sign (- (d x * 2 ^ g) * e0 g t o d) (2 ^ g * (P t d y - R t d y)) (2 ^ g * (P t d z - R t d z))).
  fold (first_sign (- (d x * 2 ^ g) * - u g t o d) (2 ^ g * - P t d y) (2 ^ g * - P t d z)).
  fold (first_sign (- (d x * 2 ^ g) * - v g t o d) (2 ^ g * R t d y) (2 ^ g * R t d z)).
  rewrite !first_sign_of_multiple by nia.
  assert (Z.sgn (- (d x * 2 ^ g * 2 ^ g) * det t d) = Z.sgn (- det t d)) as ->
    by (rewrite Z.mul_opp_l, <- Z.mul_opp_r, Z.sgn_mul; replace (Z.sgn (d x * 2 ^ g * 2 ^ g)) with 1 by nia; lia).
  assert ((Z.sgn (- det t d) =? 0) = (det t d =? 0)) as -> by lia.
  destruct (Z.eqb_spec (det t d) 0) as [| NotZero]; [reflexivity |].
  rewrite !(edge_rule _ _ _ (det t d) (det t d <? 0)) by (assumption || reflexivity).
  rewrite !sign_of_negative, !negative_is_0. unfold ok_0, ok_u, ok_v.
  set (D := det t d) in *. set (p := P t d y) in *. set (q := P t d z) in *.
  set (r := R t d y) in *. set (s := R t d z) in *.
  clearbody D p q r s. clear E0 Eu Ev Det Bu Au Bv Av B0 A0.
  cbn [negb andb]. f_equal; [f_equal |]; f_equal; f_equal.
  - decide_signs.
  - decide_signs.
  - decide_signs.
Qed.

(* ---- A ray ---- *)

(* The unit turns a ray so that it goes forward along its major axis; the line stays the same. *)
Definition unit_direction (major : Axis) (ray : IntegerRay) : Vector := fun k =>
  let s := step_of ray (ray_axis major k) in if backward ray major then - s else s.

Definition seen_by (g : Z) (major : Axis) (ray : IntegerRay) (corner : Vector) : Crossing.Place :=
  seen g (vector_in_ray_axes major (start ray)) (unit_direction major ray) (vector_in_ray_axes major corner).

Definition ray_crosses (g : Z) (major : Axis) (ray : IntegerRay) (t : Corners) : bool :=
  line_crosses g (corners_in_ray_axes major t) (vector_in_ray_axes major (start ray)) (unit_direction major ray).

Lemma unit_direction_is_forward major ray : unit_direction major ray x = slopes ray major.
Proof. unfold unit_direction, step_of. cbn [ray_axis]. destruct (backward ray major); lia. Qed.

(* The unit's numbers are those of the triangle test, all with one sign or all with the other. *)
Definition turned (major : Axis) (ray : IntegerRay) : bool :=
  xorb (backward ray major) (match major with x => false | _ => true end).

Lemma unit_numbers g major ray t :
  let o := start ray in
  let d := step_of ray in
  let unit_t := corners_in_ray_axes major t in
  let unit_o := vector_in_ray_axes major o in
  let unit_d := unit_direction major ray in
  let s := if turned major ray then -1 else 1 in
  det unit_t unit_d = s * det t d /\ e0 g unit_t unit_o unit_d = s * e0 g t o d /\
  u g unit_t unit_o unit_d = s * u g t o d /\ v g unit_t unit_o unit_d = s * v g t o d.
Proof.
  cbv zeta. unfold e0, num, v, u, det, aside, across, to_corner0, fine_corner, edge1, edge2, minus, dot, turned,
    corners_in_ray_axes, vector_in_ray_axes, unit_direction.
  set (fine := 2 ^ g). set (d := step_of ray). set (o := start ray). clearbody fine d o.
  destruct major, (backward ray _); cbn [cross corner0 corner1 corner2 ray_axis axis_a axis_b xorb];
    repeat split; ring.
Qed.

(* From which side of the world's triangle the ray comes: D . (E1 x E2) = -det. *)
Theorem world_side major ray t :
  let back := det (corners_in_ray_axes major t) (unit_direction major ray) <? 0 in
  det t (step_of ray) <> 0 ->
  (0 <? dot (step_of ray) (cross (edge1 t) (edge2 t))) = xorb back (turned major ray).
Proof.
  cbv zeta. intro NotZero. destruct (unit_numbers 0 major ray t) as [-> _].
  assert (dot (step_of ray) (cross (edge1 t) (edge2 t)) = - det t (step_of ray)) as ->
    by (unfold det, across, dot; cbn [cross]; ring).
  destruct (turned major ray); rewrite ?xorb_true_r, ?xorb_false_r; lia.
Qed.

(* What the rule takes is hit, if it is ahead. *)
Theorem crossed_ahead_is_hit g major ray t :
  let o := start ray in
  let d := step_of ray in
  0 <= g -> 0 < slopes ray major -> ray_crosses g major ray t = true -> agrees_in_sign (det t d) (- num g t o) ->
  hit_criterion g t o d.
Proof.
  intros o d G Major Crosses Ahead. unfold ray_crosses in Crosses. rewrite <- unit_rule_is_crosses in Crosses
    by (rewrite ?unit_direction_is_forward; assumption).
  destruct (unit_numbers g major ray t) as [Det [E [U V]]]. fold o d in Det, E, U, V.
  unfold unit_rule in Crosses. fold o in Crosses. rewrite Det, E, U, V in Crosses.
  rewrite !andb_true_iff in Crosses. destruct Crosses as [[[NotZero [E0 _]] [U0 _]] [V0 _]].
  unfold has_sign in E0, U0, V0.
  constructor; [| | | | exact Ahead]; try (apply agreement);
    destruct (turned major ray); lia.
Qed.

(* What is hit strictly inside, the rule takes. *)
Theorem hit_inside_is_crossed g major ray t :
  let o := start ray in
  let d := step_of ray in
  0 <= g -> 0 < slopes ray major -> hit_criterion g t o d -> e0 g t o d <> 0 -> u g t o d <> 0 -> v g t o d <> 0 ->
  ray_crosses g major ray t = true.
Proof.
  intros o d G Major [NotZero E U V _] E0 U0 V0. unfold ray_crosses.
  rewrite <- unit_rule_is_crosses by (rewrite ?unit_direction_is_forward; assumption).
  destruct (unit_numbers g major ray t) as [IsDet [IsE [IsU IsV]]]. fold o d in IsDet, IsE, IsU, IsV.
  unfold unit_rule. fold o. rewrite IsDet, IsE, IsU, IsV. unfold has_sign.
  apply agreement in E, U, V; try exact NotZero. destruct (turned major ray); lia.
Qed.

(* ---- Two triangles at an edge ---- *)

(* Triangles c d e and c d f meet at the edge from c to d. By the numbers of the test of c d e, the ray's line
   passes the edge exactly, v = 0, and between its ends. The sign of det says on which side of the edge a triangle
   is. *)
Section Edge.
Variables (g : Z) (major : Axis) (ray : IntegerRay) (c d e f : Vector).

Let one : Corners := {| corner0 := c; corner1 := d; corner2 := e |}.
Let other : Corners := {| corner0 := c; corner1 := d; corner2 := f |}.
Let o := start ray.
Let step := step_of ray.
Let see := seen_by g major ray.

Hypotheses (G : 0 <= g) (Major : 0 < slopes ray major).
Hypotheses (Exactly : v g one o step = 0) (Between : 0 < e0 g one o step * - u g one o step).

Lemma passes_within_edge : SharedEdge.passes_within (see c) (see d).
Proof using G Major Exactly Between.
  destruct (edges_seen g (corners_in_ray_axes major one) (vector_in_ray_axes major o) (unit_direction major ray))
    as [E0 [Eu [Ev _]]].
  destruct (unit_numbers g major ray one) as [_ [IsE [IsU IsV]]]. fold o step in IsE, IsU, IsV.
  rewrite IsE in E0. rewrite IsU in Eu. rewrite IsV, Exactly in Ev. rewrite unit_direction_is_forward in *.
  pose proof (power_positive g G) as Fine. apply (SharedEdge.passes_within_by_test _ _ (see e)).
  - etransitivity; [exact Ev | ring].
  - pose proof (f_equal2 Z.mul E0 Eu) as Product. unfold see.
    eapply Z.lt_le_trans; [| apply Z.eq_le_incl; symmetry; exact Product].
    assert (0 < slopes ray major * 2 ^ g) as Scale by nia.
    set (k := slopes ray major * 2 ^ g) in *. clearbody k. clear - Scale Between.
    assert (0 < k * k * (e0 g one o step * - u g one o step)) by nia. destruct (turned major ray); lia.
Qed.

Lemma sides_of_edge :
  exists s, 0 < s /\ Crossing.det (see c) (see d) (see e) * Crossing.det (see c) (see d) (see f) =
                     s * (det one step * det other step).
Proof using G Major.
  destruct (edges_seen g (corners_in_ray_axes major one) (vector_in_ray_axes major o) (unit_direction major ray))
    as [_ [_ [_ Det]]].
  destruct (edges_seen g (corners_in_ray_axes major other) (vector_in_ray_axes major o) (unit_direction major ray))
    as [_ [_ [_ Det']]].
  destruct (unit_numbers g major ray one) as [Is _], (unit_numbers g major ray other) as [Is' _].
  fold step in Is, Is'. rewrite Is in Det. rewrite Is' in Det'. rewrite unit_direction_is_forward in *.
  pose proof (power_positive g G) as Fine. set (k := slopes ray major * 2 ^ g * 2 ^ g) in *.
  exists (k * k). split; [unfold k; nia |].
  etransitivity; [exact (f_equal2 Z.mul Det Det') |]. destruct (turned major ray); ring.
Qed.

(* On both sides, exactly one of the two is crossed. *)
Theorem ray_crosses_one_at_edge :
  det one step * det other step < 0 -> xorb (ray_crosses g major ray one) (ray_crosses g major ray other) = true.
Proof using G Major Exactly Between.
  intro Sides. destruct sides_of_edge as [s [Positive Is]].
  apply (SharedEdge.shared_edge_is_crossed_once (see c) (see d) (see e) (see f)); [exact passes_within_edge |].
  unfold SharedEdge.on_both_sides. rewrite Is. nia.
Qed.

(* On one side, none or both. *)
Theorem ray_crosses_evenly_at_fold :
  0 < det one step * det other step -> ray_crosses g major ray one = ray_crosses g major ray other.
Proof using G Major Exactly Between.
  intro Sides. destruct sides_of_edge as [s [Positive Is]].
  apply (SharedEdge.folded_edge_is_crossed_evenly (see c) (see d) (see e) (see f)); [exact passes_within_edge |].
  unfold SharedEdge.on_one_side. rewrite Is. nia.
Qed.
End Edge.

(* ---- A mesh ---- *)

Section Mesh.
Variables (Corner : Type) (same : forall c d : Corner, {c = d} + {c <> d}) (position : Corner -> Vector).
Variables (g : Z) (major : Axis) (ray : IntegerRay).

Definition triangle_of (t : CrossingMesh.Triangle Corner) : Corners :=
  let '(c, d, e) := t in {| corner0 := position c; corner1 := position d; corner2 := position e |}.

(* The headline. It is about the whole line of the ray: hits ahead and behind. *)
Theorem ray_crosses_closed_mesh_evenly mesh :
  CrossingMesh.closed Corner same mesh ->
  Nat.Even (List.length (filter (fun t => ray_crosses g major ray (triangle_of t)) mesh)).
Proof using.
  intro Closed.
  pose proof (CrossingMesh.closed_mesh_is_crossed_evenly Corner same (fun c => seen_by g major ray (position c))
                mesh Closed) as Even.
  erewrite filter_ext; [exact Even |]. intros [[c d] e]. reflexivity.
Qed.
End Mesh.
