(* Triangles ahead of a ray's origin: a crossing is ahead if its distance is not negative.

   A point is seen from the origin along the ray: its place across the ray, and its height along it. This file says
   what a crossed triangle tells of the origin, and what two crossed faces of a tetrahedron tell: if one is ahead
   and one behind, the origin is between them. Tetrahedron.v goes on from there. *)
From Coq Require Import ZArith Lia Bool.
From HitpipeMajor Require Import Crossing.
Open Scope Z_scope.

Record Point : Set := { place : Place; height : Z }.

(* The determinant of three points: 0 in a plane with the origin. *)
Definition volume (p q r : Point) : Z :=
  edge (place q) (place r) * height p + edge (place r) (place p) * height q + edge (place p) (place q) * height r.

(* The origin is on the closed triangle: it is a mean of the corners. *)
Definition holds_origin (p q r : Point) : Prop :=
  exists a b c, 0 <= a /\ 0 <= b /\ 0 <= c /\ 0 < a + b + c /\
    a * A (place p) + b * A (place q) + c * A (place r) = 0 /\
    a * B (place p) + b * B (place q) + c * B (place r) = 0 /\
    a * height p + b * height q + c * height r = 0.

(* 1 or -1, by the side from which the line comes, or 0 if it does not cross the triangle. *)
Definition sign_of_face (p q r : Point) : Z := crossing_sign (place p) (place q) (place r).

(* The line crosses the triangle's plane at height volume / det. *)
Definition ahead (p q r : Point) : bool := 0 <=? volume p q r * det (place p) (place q) (place r).

(* The same, but 0 if the crossing is behind the origin. *)
Definition sign_ahead (p q r : Point) : Z := if ahead p q r then sign_of_face p q r else 0.

(* ---- One face ---- *)

(* A crossed face says of its edges' determinants that none has the other sign. *)
Lemma crossed_face p q r s :
  sign_of_face p q r = s -> s <> 0 ->
  Z.sgn (det (place p) (place q) (place r)) = s /\ 0 <= s * edge (place p) (place q) /\
  0 <= s * edge (place q) (place r) /\ 0 <= s * edge (place r) (place p).
Proof.
  unfold sign_of_face, crossing_sign. destruct (crosses _ _ _) eqn:Crosses; [| congruence].
  intros <- _. apply crossed_is_hit in Crosses. destruct Crosses as [_ Signs]. split; [reflexivity |].
  assert (forall e, e = 0 \/ Z.sgn e = Z.sgn (det (place p) (place q) (place r)) ->
            0 <= Z.sgn (det (place p) (place q) (place r)) * e) as Product by (intros e [-> | <-]; lia || nia).
  repeat split; apply Product, Signs; cbn; auto.
Qed.

(* A crossed face in a plane with the origin holds it. *)
Lemma crossed_at_origin p q r : sign_of_face p q r <> 0 -> volume p q r = 0 -> holds_origin p q r.
Proof.
  intros Crossed Flat. destruct (crossed_face p q r _ eq_refl Crossed) as [Det [Pq [Qr Rp]]].
  set (s := sign_of_face p q r) in *. unfold volume in Flat.
  exists (s * edge (place q) (place r)), (s * edge (place r) (place p)), (s * edge (place p) (place q)).
  split; [exact Qr |]. split; [exact Rp |]. split; [exact Pq |]. split; [unfold det in Det; nia |].
  repeat split; [unfold edge; ring | unfold edge; ring |].
  rewrite <- !Z.mul_assoc, <- !Z.mul_add_distr_l, Flat. ring.
Qed.

(* ---- Orders of the corners ---- *)

Lemma volume_from_next p q r : volume q r p = volume p q r.
Proof. unfold volume. ring. Qed.

Lemma volume_turned p q r : volume q p r = - volume p q r.
Proof. unfold volume, edge. ring. Qed.

Lemma sign_ahead_turned z p q : sign_ahead z q p = - sign_ahead z p q.
Proof.
  unfold sign_ahead, ahead, sign_of_face.
  assert (volume z q p = - volume z p q) as -> by (unfold volume, edge; ring).
  assert (det (place z) (place q) (place p) = - det (place z) (place p) (place q)) as ->
    by (unfold det, edge; ring).
  rewrite Z.mul_opp_opp, (sign_from_next_corner (place p) (place z) (place q)), sign_from_other_side.
  destruct (_ <=? _); lia.
Qed.

Lemma holds_origin_from_next p q r : holds_origin q r p -> holds_origin p q r.
Proof. intros [a [b [c H]]]. exists c, a, b. lia. Qed.

Lemma holds_origin_turned p q r : holds_origin q p r -> holds_origin p q r.
Proof. intros [a [b [c H]]]. exists b, a, c. lia. Qed.

(* ---- Four points ---- *)

(* Of four points, each times the volume of the others, the sum is 0. *)
Lemma four_points a b c d (f : Point -> Z) :
  f = height \/ f = (fun p => A (place p)) \/ f = (fun p => B (place p)) ->
  volume b c d * f a - volume a c d * f b + volume a b d * f c - volume a b c * f d = 0.
Proof. intros [-> | [-> | ->]]; unfold volume, edge; ring. Qed.

(* If two faces are crossed, one ahead and one behind, the origin is between them: all volumes have one sign. *)
Lemma between_faces a b c d s :
  sign_of_face a b c = s -> sign_of_face a b d = s -> s <> 0 -> volume a b c * volume a b d < 0 ->
  ~ holds_origin a c d -> ~ holds_origin b c d ->
  0 < volume b c d * volume a b d /\ volume a c d * volume a b d < 0.
Proof.
  intros Sc Sd NotZero Opposite Acd Bcd.
  destruct (crossed_face _ _ _ _ Sc NotZero) as [DetC [AB [BC CA]]].
  destruct (crossed_face _ _ _ _ Sd NotZero) as [DetD [_ [BD DA]]].
  pose proof (four_points a b c d (fun p => A (place p)) ltac:(auto)) as OfA.
  pose proof (four_points a b c d (fun p => B (place p)) ltac:(auto)) as OfB.
  pose proof (four_points a b c d height ltac:(auto)) as OfH. cbv beta in OfA, OfB.
  set (wa := volume b c d) in *. set (wb := - volume a c d) in *.
  set (wc := volume a b d) in *. set (wd := - volume a b c) in *.
  assert (wb * (s * edge (place a) (place b)) =
          wc * (s * edge (place c) (place a)) + wd * (s * edge (place d) (place a))) as AtA.
  { unfold edge, wb, wd. apply Z.sub_move_0_r.
    transitivity (s * (A (place a) * (wa * B (place a) - volume a c d * B (place b) + wc * B (place c) -
                                      volume a b c * B (place d)) -
                       B (place a) * (wa * A (place a) - volume a c d * A (place b) + wc * A (place c) -
                                      volume a b c * A (place d)))); [ring | rewrite OfA, OfB; ring]. }
  assert (wa * (s * edge (place a) (place b)) =
          wc * (s * edge (place b) (place c)) + wd * (s * edge (place b) (place d))) as AtB.
  { unfold edge, wb, wd. apply Z.sub_move_0_r.
    transitivity (s * (A (place b) * - (wa * B (place a) - volume a c d * B (place b) + wc * B (place c) -
                                      volume a b c * B (place d)) +
                       B (place b) * (wa * A (place a) - volume a c d * A (place b) + wc * A (place c) -
                                      volume a b c * A (place d)))); [ring | rewrite OfA, OfB; ring]. }
  assert (0 < s * edge (place a) (place b) + s * edge (place b) (place c) + s * edge (place c) (place a)) as Sum.
  { replace (_ + _ + _) with (s * det (place a) (place b) (place c)) by (unfold det; ring).
    clear - DetC NotZero. nia. }
  assert (volume a c d = - wb) as IsB by (unfold wb; ring). rewrite IsB in *.
  assert (volume a b c = - wd) as IsD by (unfold wd; ring). rewrite IsD in *.
  clearbody wa wb wc wd. clear IsB IsD Sc Sd DetC DetD.
  set (ab := s * edge (place a) (place b)) in *. set (bc := s * edge (place b) (place c)) in *.
  set (ca := s * edge (place c) (place a)) in *. set (bd := s * edge (place b) (place d)) in *.
  set (da := s * edge (place d) (place a)) in *. clearbody ab bc ca bd da.
  assert (exists k, (k = 1 \/ k = -1) /\ 0 < k * wc /\ 0 < k * wd) as [k [K [Wc Wd]]]
    by (clear - Opposite; destruct (Z.sgn_spec wc) as [[? _] | [[? _] | [? _]]];
        [exists 1 | exists 1 | exists (-1)]; (split; [auto | split; nia])).
  assert (k * wb * ab = k * wc * ca + k * wd * da) as KA by (transitivity (k * (wb * ab)); [| rewrite AtA]; ring).
  assert (k * wa * ab = k * wc * bc + k * wd * bd) as KB by (transitivity (k * (wa * ab)); [| rewrite AtB]; ring).
  assert (0 < ab) as Ab.
  { destruct (Z_le_lt_eq_dec 0 ab AB) as [| Zero]; [assumption |]. rewrite <- Zero, Z.mul_0_r in KA, KB.
    assert (ca = 0 /\ bc = 0) by (clear - BC CA BD DA KA KB Wc Wd; split; nia). lia. }
  assert (0 <= k * wb) as Wb by (clear - CA DA KA Wc Wd Ab; nia).
  assert (0 <= k * wa) as Wa by (clear - BC BD KB Wc Wd Ab; nia).
  assert (wb <> 0) as NotB.
  { intros ->. apply Acd. exists (k * wa), (k * wc), (k * wd). repeat split; try lia; clear - OfA OfB OfH; nia. }
  assert (wa <> 0) as NotA.
  { intros ->. apply Bcd. exists (k * wb), (k * wc), (k * wd). repeat split; try lia; clear - OfA OfB OfH; nia. }
  clear - K Wa Wb Wc Wd NotA NotB. nia.
Qed.
