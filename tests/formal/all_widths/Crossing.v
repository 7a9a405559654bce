(* Which triangles a line crosses, exactly once: the rule for a line that passes an edge or a corner exactly.

   The closed test of a triangle takes such a line for both triangles of an edge, so a count of hits can be
   odd where it must be even. The rule decides as if the line were moved by (eps, eps^2), for an eps so small
   that it matters at an edge that the line passes exactly, and nowhere else. No number is rounded or moved:
   where an edge's determinant is 0, the sign of a difference of its ends' places decides.

   This file has the rule, what the moved line has to do with it, and that the rule takes only closed hits.
   - CrossingMesh.v: a line crosses a closed mesh an even number of times.
   - SharedEdge.v: of two triangles at an edge that the line passes, one is crossed.
   - CrossingRay.v: the rule in the numbers of the triangle unit.
   - FaceAhead.v, Tetrahedron.v, CrossingOrigin.v: from a ray's origin on, the count is odd for all directions or
     even for all. *)
From Coq Require Import ZArith Lia Bool List.
Import ListNotations.
Open Scope Z_scope.

(* ---- The rule ---- *)

(* A corner as seen along the line, which is the point (0, 0). *)
Record Place : Set := { A : Z; B : Z }.

Definition edge (p q : Place) : Z := A p * B q - A q * B p.
Definition det (p q r : Place) : Z := edge q r + edge r p + edge p q.

(* The first that is not 0. *)
Definition first_not_zero (e b a : Z) : Z := if e =? 0 then if b =? 0 then a else b else e.

(* The side on which the line passes the edge from p to q. *)
Definition side (p q : Place) : Z := Z.sgn (first_not_zero (edge p q) (B p - B q) (A q - A p)).

(* The line passes all three edges on the same side, and the triangle is not seen edge-on. *)
Definition crosses (p q r : Place) : bool :=
  let s := Z.sgn (det p q r) in
  negb (s =? 0) && (side q r =? s) && (side r p =? s) && (side p q =? s).

(* 1, -1, or 0 if the line does not cross the triangle. *)
Definition crossing_sign (p q r : Place) : Z := if crosses p q r then Z.sgn (det p q r) else 0.

(* ---- The moved line ---- *)

(* The line passes every edge on a side, unless the edge is a point as seen along the line. *)
Lemma side_is_zero p q : side p q = 0 -> p = q.
Proof.
  unfold side. rewrite Z.sgn_null_iff. unfold first_not_zero, edge. destruct p as [ap bp], q as [aq bq]. cbn [A B].
  destruct (Z.eqb_spec (ap * bq - aq * bp) 0); [| congruence].
  destruct (Z.eqb_spec (bp - bq) 0); [| congruence]. intro. f_equal; lia.
Qed.

(* For an eps of 1 / n, and n large enough, the sign of one number says the same. *)
Lemma first_not_zero_is n e b a :
  Z.abs b < n -> Z.abs a < n -> Z.sgn (n * n * e + n * b + a) = Z.sgn (first_not_zero e b a).
Proof.
  intros Hb Ha. unfold first_not_zero.
  assert (forall x y m, Z.abs y < m -> x <> 0 -> Z.sgn (m * x + y) = Z.sgn x) as Lead by (intros; nia).
  destruct (Z.eqb_spec e 0) as [-> |]; [destruct (Z.eqb_spec b 0) as [-> |] |].
  - f_equal; lia.
  - rewrite <- (Lead b a n) by assumption. f_equal; lia.
  - rewrite <- (Lead e (n * b + a) (n * n)) by nia. f_equal; lia.
Qed.

(* A place as seen from the moved line, times n^2 to stay an integer. *)
Definition moved (n : Z) (p : Place) : Place := {| A := n * n * A p - n; B := n * n * B p - 1 |}.

(* How large n must be for an edge. *)
Definition far_enough (n : Z) (p q : Place) : Prop := Z.abs (B p - B q) < n /\ Z.abs (A q - A p) < n.

(* The rule's side of an edge is the side of the moved line, which passes no edge exactly. *)
Lemma side_of_moved n p q : 0 < n -> far_enough n p q -> Z.sgn (edge (moved n p) (moved n q)) = side p q.
Proof.
  intros Positive [Hb Ha]. unfold side. rewrite <- (first_not_zero_is n) by assumption.
  replace (edge (moved n p) (moved n q))
    with (n * n * (n * n * edge p q + n * (B p - B q) + (A q - A p)))
    by (unfold edge, moved; cbn [A B]; ring).
  rewrite Z.sgn_mul. replace (Z.sgn (n * n)) with 1 by nia. lia.
Qed.

Lemma edge_of_moved_is_not_zero n p q : 0 < n -> far_enough n p q -> edge (moved n p) (moved n q) = 0 -> p = q.
Proof.
  intros Positive Far Zero. pose proof (side_of_moved n p q Positive Far) as Side. rewrite Zero in Side.
  symmetry in Side. apply side_is_zero in Side. exact Side.
Qed.

(* ---- Edges through a half-line ---- *)

(* The half-line goes from the moved line's point along +a. An edge crosses it upward, 1, downward, -1, or not. *)
Definition above (p : Place) : bool := 0 <? B p.
Definition through (p q : Place) : Z :=
  match above p, above q with
  | false, true => if side p q =? 1 then 1 else 0
  | true, false => if side p q =? -1 then -1 else 0
  | _, _ => 0
  end.

Lemma moved_is_above n p :
  1 < n -> (0 < B (moved n p) <-> above p = true) /\ (B (moved n p) < 0 <-> above p = false).
Proof.
  intro. unfold above. cbn [moved B].
  destruct (Z.ltb_spec 0 (B p)); split; split; intro; try discriminate; nia.
Qed.

Lemma det_of_moved n p q r : det (moved n p) (moved n q) (moved n r) = n * n * (n * n) * det p q r.
Proof. unfold det, edge, moved. cbn [A B]. ring. Qed.

(* Three places are dependent. *)
Lemma heights_and_edges p q r : B p * edge q r + B q * edge r p + B r * edge p q = 0.
Proof. unfold edge. ring. Qed.

Lemma exists_far_enough p q r : exists n, 1 < n /\ far_enough n p q /\ far_enough n q r /\ far_enough n r p.
Proof.
  exists (2 + Z.abs (B p - B q) + Z.abs (A q - A p) + Z.abs (B q - B r) + Z.abs (A r - A q) +
          Z.abs (B r - B p) + Z.abs (A p - A r)).
  unfold far_enough. lia.
Qed.

(* The heart: what a triangle's edges add up to is whether the line crosses the triangle, and from where. An edge
   belongs to all of its triangles, so over a mesh the sum is known. *)
Theorem triangle_edges p q r : through p q + through q r + through r p = crossing_sign p q r.
Proof.
  destruct (exists_far_enough p q r) as [n [N [Fpq [Fqr Frp]]]].
  pose proof (heights_and_edges (moved n p) (moved n q) (moved n r)) as Dependent.
  pose proof (det_of_moved n p q r) as Det. unfold det in Det at 1.
  assert (0 < n * n * (n * n)) as Scale by nia.
  assert (Z.sgn (det p q r) = Z.sgn (n * n * (n * n) * det p q r)) as SignDet
    by (rewrite Z.sgn_mul; replace (Z.sgn (n * n * (n * n))) with 1 by lia; lia).
  rewrite <- Det in SignDet. clear Det Scale.
  pose proof (side_of_moved n p q ltac:(lia) Fpq) as Spq.
  pose proof (side_of_moved n q r ltac:(lia) Fqr) as Sqr.
  pose proof (side_of_moved n r p ltac:(lia) Frp) as Srp.
  destruct (moved_is_above n p N) as [Up Dp], (moved_is_above n q N) as [Uq Dq].
  destruct (moved_is_above n r N) as [Ur Dr].
  unfold through, crossing_sign, crosses. rewrite <- Spq, <- Sqr, <- Srp, SignDet. clear SignDet Spq Sqr Srp.
  assert (forall u v, far_enough n u v -> edge (moved n u) (moved n v) = 0 -> B (moved n u) = B (moved n v))
    as Apart
    by (intros u v Far Zero; apply edge_of_moved_is_not_zero in Zero; [congruence | lia | exact Far]).
  pose proof (Apart p q Fpq) as Apq. pose proof (Apart q r Fqr) as Aqr. pose proof (Apart r p Frp) as Arp.
  clear Apart.
  set (a := edge (moved n q) (moved n r)) in *. set (b := edge (moved n r) (moved n p)) in *.
  set (c := edge (moved n p) (moved n q)) in *.
  set (x := B (moved n p)) in *. set (y := B (moved n q)) in *. set (z := B (moved n r)) in *.
  clearbody a b c x y z. clear Fpq Fqr Frp N n.
  revert Up Dp Uq Dq Ur Dr. generalize (above p) (above q) (above r). intros [] [] [] Up Dp Uq Dq Ur Dr;
    destruct Up as [_ Up], Dp as [_ Dp], Uq as [_ Uq], Dq as [_ Dq], Ur as [_ Ur], Dr as [_ Dr];
    repeat match goal with
    | H : true = true -> _ |- _ => specialize (H eq_refl)
    | H : false = false -> _ |- _ => specialize (H eq_refl)
    | H : true = false -> _ |- _ => clear H
    | H : false = true -> _ |- _ => clear H
    end;
    destruct (Z.sgn_spec a) as [[? ->] | [[? ->] | [? ->]]], (Z.sgn_spec b) as [[? ->] | [[? ->] | [? ->]]],
      (Z.sgn_spec c) as [[? ->] | [[? ->] | [? ->]]],
      (Z.sgn_spec (a + b + c)) as [[? ->] | [[? ->] | [? ->]]]; cbn; try reflexivity; nia.
Qed.

(* The sides of the three edges alone decide. *)
Lemma sign_by_sides p q r :
  crossing_sign p q r = if (side q r =? side p q) && (side r p =? side p q) then side p q else 0.
Proof.
  destruct (exists_far_enough p q r) as [n [N [Fpq [Fqr Frp]]]].
  pose proof (det_of_moved n p q r) as Det. unfold det in Det at 1.
  assert (Z.sgn (det p q r) = Z.sgn (n * n * (n * n) * det p q r)) as SignDet
    by (rewrite Z.sgn_mul; replace (Z.sgn (n * n * (n * n))) with 1 by nia; lia).
  rewrite <- Det in SignDet. unfold crossing_sign, crosses. rewrite SignDet.
  rewrite <- (side_of_moved n p q), <- (side_of_moved n q r), <- (side_of_moved n r p) by (assumption || lia).
  set (a := edge (moved n q) (moved n r)). set (b := edge (moved n r) (moved n p)).
  set (c := edge (moved n p) (moved n q)). clearbody a b c. clear.
  destruct (Z.sgn_spec a) as [[? ->] | [[? ->] | [? ->]]], (Z.sgn_spec b) as [[? ->] | [[? ->] | [? ->]]],
    (Z.sgn_spec c) as [[? ->] | [[? ->] | [? ->]]],
    (Z.sgn_spec (a + b + c)) as [[? ->] | [[? ->] | [? ->]]]; cbn; try reflexivity; lia.
Qed.

(* ---- The order of the corners ---- *)

Lemma side_turned p q : side q p = - side p q.
Proof.
  unfold side, first_not_zero.
  replace (edge q p) with (- edge p q) by (unfold edge; ring).
  replace (B q - B p) with (- (B p - B q)) by ring. replace (A p - A q) with (- (A q - A p)) by ring.
  destruct (Z.eqb_spec (- edge p q) 0), (Z.eqb_spec (edge p q) 0); try lia;
    destruct (Z.eqb_spec (- (B p - B q)) 0), (Z.eqb_spec (B p - B q) 0); lia.
Qed.

Lemma through_turned p q : through q p = - through p q.
Proof.
  unfold through. rewrite side_turned.
  destruct (above p), (above q); try reflexivity;
    destruct (Z.eqb_spec (side p q) 1), (Z.eqb_spec (side p q) (-1)), (Z.eqb_spec (- side p q) 1),
      (Z.eqb_spec (- side p q) (-1)); lia.
Qed.

Lemma sign_from_next_corner p q r : crossing_sign q r p = crossing_sign p q r.
Proof. rewrite <- !triangle_edges. ring. Qed.

Lemma sign_from_other_side p q r : crossing_sign q p r = - crossing_sign p q r.
Proof. rewrite <- !triangle_edges, (through_turned r q), (through_turned q p), (through_turned p r). ring. Qed.

Lemma crossing_sign_is p q r :
  crossing_sign p q r = 1 \/ crossing_sign p q r = -1 \/ crossing_sign p q r = 0 /\ crosses p q r = false.
Proof.
  unfold crossing_sign. destruct (crosses p q r) eqn:Crosses; [| auto].
  unfold crosses in Crosses. destruct (Z.sgn_spec (det p q r)) as [[_ S] | [[_ S] | [_ S]]]; rewrite S in *; auto.
Qed.

Lemma crosses_by_sign p q r : crosses p q r = negb (crossing_sign p q r =? 0).
Proof.
  unfold crossing_sign. destruct (crosses p q r) eqn:Crosses; [| reflexivity].
  unfold crosses in Crosses. rewrite !andb_true_iff in Crosses. destruct Crosses as [[[NotZero _] _] _].
  symmetry. exact NotZero.
Qed.

(* The rule depends neither on which corner is first nor on the sense in which the corners run. *)
Theorem crosses_from_next_corner p q r : crosses q r p = crosses p q r.
Proof. rewrite !crosses_by_sign, sign_from_next_corner. reflexivity. Qed.

Theorem crosses_from_other_side p q r : crosses q p r = crosses p q r.
Proof.
  rewrite !crosses_by_sign, sign_from_other_side.
  destruct (crossing_sign_is p q r) as [-> | [-> | [-> _]]]; reflexivity.
Qed.

(* ---- The closed test ---- *)

(* What is crossed is hit by the closed test: no edge's determinant has the other sign. *)
Theorem crossed_is_hit p q r :
  crosses p q r = true ->
  det p q r <> 0 /\ forall e, In e [edge q r; edge r p; edge p q] -> e = 0 \/ Z.sgn e = Z.sgn (det p q r).
Proof.
  unfold crosses, side, first_not_zero. rewrite !andb_true_iff, negb_true_iff, !Z.eqb_eq, Z.eqb_neq.
  intros [[[NotZero First] Second] Third]. split; [lia |].
  intros e [<- | [<- | [<- | []]]].
  - destruct (Z.eqb_spec (edge q r) 0); auto.
  - destruct (Z.eqb_spec (edge r p) 0); auto.
  - destruct (Z.eqb_spec (edge p q) 0); auto.
Qed.

(* What is hit strictly inside is crossed. *)
Theorem hit_inside_is_crossed p q r :
  det p q r <> 0 -> (forall e, In e [edge q r; edge r p; edge p q] -> Z.sgn e = Z.sgn (det p q r)) ->
  crosses p q r = true.
Proof.
  intros NotZero Signs. unfold crosses, side, first_not_zero.
  pose proof (Signs _ (or_introl eq_refl)) as First.
  pose proof (Signs _ (or_intror (or_introl eq_refl))) as Second.
  pose proof (Signs _ (or_intror (or_intror (or_introl eq_refl)))) as Third.
  rewrite !andb_true_iff, negb_true_iff, !Z.eqb_eq, Z.eqb_neq.
  destruct (Z.eqb_spec (edge q r) 0), (Z.eqb_spec (edge r p) 0), (Z.eqb_spec (edge p q) 0); lia.
Qed.
