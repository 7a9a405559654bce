(* Two triangles at an edge that the line passes exactly: one of the two is crossed, or none or both.

   The edge runs from c to d, and e and f are the third corners of its two triangles. As seen along the line, e
   and f may lie on both sides of the edge, or on the same side, where the surface folds back.
   - The line passes within the edge. On both sides, exactly one triangle is crossed. On one side, none or both.
   - The line passes at an end of the edge. Then other triangles meet there too. On both sides the two are not
     both crossed, but perhaps neither is: `corner_may_be_left`. Only the sum over all triangles is even. *)
From Coq Require Import ZArith Lia Bool.
From HitpipeMajor Require Import Crossing.
Open Scope Z_scope.

(* The line passes the edge exactly, and sees its ends in opposite directions. *)
Definition passes_within (c d : Place) : Prop := edge c d = 0 /\ A c * A d + B c * B d < 0.

(* In other words, the line is a mean of the ends with weights above 0, and the ends are apart. *)
Theorem passes_within_is c d :
  passes_within c d <->
  (c <> d /\ exists w z, 0 < w /\ 0 < z /\ w * A c + z * A d = 0 /\ w * B c + z * B d = 0).
Proof.
  destruct c as [a b], d as [a' b']. unfold passes_within, edge. cbn [A B]. split.
  - intros [Zero Opposite]. split; [intro Same; injection Same as -> ->; nia |].
    exists (a' * a' + b' * b'), (- (a * a' + b * b')). repeat split; try nia.
    + transitivity (b' * (a * b' - a' * b)); [ring | rewrite Zero; ring].
    + transitivity (- (a' * (a * b' - a' * b))); [ring | rewrite Zero; ring].
  - intros [Apart [w [z [W [Z [OfA OfB]]]]]].
    assert (w * (a * b' - a' * b) = 0) as Edge
      by (transitivity ((w * a + z * a') * b' - (w * b + z * b') * a'); [ring | rewrite OfA, OfB; ring]).
    assert (w * (a * a' + b * b') = - (z * (a' * a' + b' * b'))) as Product
      by (transitivity ((w * a + z * a') * a' + (w * b + z * b') * b' - z * (a' * a' + b' * b'));
          [ring | rewrite OfA, OfB; ring]).
    split; [nia |].
    assert (0 < a' * a' + b' * b') as Far; [| nia].
    destruct (Z.eq_dec a' 0) as [-> |]; [destruct (Z.eq_dec b' 0) as [-> |]; [| nia] | nia].
    exfalso. apply Apart. f_equal; nia.
Qed.

(* So says the closed test of a triangle at the edge, if it is hit and no other edge is passed exactly. *)
Lemma passes_within_by_test c d e : edge c d = 0 -> 0 < edge d e * edge e c -> passes_within c d.
Proof.
  intros Zero Same. split; [exact Zero |].
  set (p := edge d e) in *. set (q := edge e c) in *.
  assert ((A c * A d + B c * B d) * p = - ((A d * A d + B d * B d) * q)) as Ratio.
  { transitivity (- ((A d * A d + B d * B d) * q) - (A d * A e + B d * B e) * edge c d);
      [unfold p, q, edge; ring | rewrite Zero; ring]. }
  assert (0 < A d * A d + B d * B d) as Far.
  { destruct (Z.eq_dec (A d) 0) as [ZeroA |]; [| nia]. destruct (Z.eq_dec (B d) 0) as [ZeroB |]; [| nia].
    assert (p = 0) as Flat by (unfold p, edge; rewrite ZeroA, ZeroB; ring). rewrite Flat in Same. lia. }
  set (k := A c * A d + B c * B d) in *. set (m := A d * A d + B d * B d) in *.
  clearbody k m p q. clear - Same Ratio Far.
  assert (k * (p * q) = - (m * (q * q))) as Square by (transitivity (k * p * q); [ring | rewrite Ratio; ring]).
  assert (q <> 0) by (intros ->; lia). assert (0 < m * (q * q)) by nia. nia.
Qed.

(* The sign of det c d e is the side of the edge on which e is seen. *)
Definition on_both_sides (c d e f : Place) : Prop := det c d e * det c d f < 0.
Definition on_one_side (c d e f : Place) : Prop := 0 < det c d e * det c d f.

(* A triangle at an edge that the line passes within is crossed if the rule's side of the edge is its own. *)
Lemma crosses_at_edge c d e :
  passes_within c d -> det c d e <> 0 -> crosses c d e = (side c d =? Z.sgn (det c d e)).
Proof.
  intros [Zero Opposite] NotFlat. unfold crosses.
  assert (A c * edge d e = - (A d * edge e c) /\ B c * edge d e = - (B d * edge e c)) as [OfA OfB].
  { unfold edge in *. split.
    - transitivity (- (A d * (A e * B c - A c * B e)) - A e * (A c * B d - A d * B c));
        [ring | rewrite Zero; ring].
    - transitivity (- (B d * (A e * B c - A c * B e)) - B e * (A c * B d - A d * B c));
        [ring | rewrite Zero; ring]. }
  assert (0 < edge d e * edge e c) as Same.
  { assert (edge d e + edge e c <> 0) as Sum by (unfold det in NotFlat; lia).
    set (p := edge d e) in *. set (q := edge e c) in *.
    assert ((A c * A d + B c * B d) * p = - ((A d * A d + B d * B d) * q)) as Ratio
      by (transitivity (A d * (A c * p) + B d * (B c * p)); [ring | rewrite OfA, OfB; ring]).
    assert (0 < A d * A d + B d * B d) as Far.
    { clear - Opposite. destruct (Z.eq_dec (A d) 0) as [Zero |]; [rewrite Zero in *; nia | nia]. }
    clear - Opposite Sum Ratio Far.
    set (k := A c * A d + B c * B d) in *. set (m := A d * A d + B d * B d) in *. clearbody k m p q.
    assert (q <> 0) as NotZero by (intros ->; nia).
    assert (k * (p * q) = - (m * (q * q))) as Square by (transitivity (k * p * q); [ring | rewrite Ratio; ring]).
    assert (0 < m * (q * q)) by nia. nia. }
  assert (Z.sgn (edge d e) = Z.sgn (det c d e) /\ Z.sgn (edge e c) = Z.sgn (det c d e)) as [First Second]
    by (unfold det; rewrite Zero, Z.add_0_r; clear - Same; lia || nia).
  assert (side d e = Z.sgn (det c d e) /\ side e c = Z.sgn (det c d e)) as [-> ->].
  { unfold side, first_not_zero. clear - Same First Second.
    destruct (Z.eqb_spec (edge d e) 0), (Z.eqb_spec (edge e c) 0); lia || nia. }
  rewrite Z.eqb_refl. destruct (Z.eqb_spec (Z.sgn (det c d e)) 0); [lia | reflexivity].
Qed.

(* The headline. *)
Theorem shared_edge_is_crossed_once c d e f :
  passes_within c d -> on_both_sides c d e f -> xorb (crosses c d e) (crosses c d f) = true.
Proof.
  intros Within Sides. unfold on_both_sides in Sides.
  rewrite !crosses_at_edge by (assumption || nia).
  assert (side c d <> 0) as NotZero
    by (intro Same; apply side_is_zero in Same; subst d; destruct Within; nia).
  assert (Z.sgn (det c d e) = - Z.sgn (det c d f)) as -> by nia.
  assert (side c d = 1 \/ side c d = -1) as [-> | ->]
    by (unfold side in *; destruct (Z.sgn_spec (first_not_zero (edge c d) (B c - B d) (A d - A c))); lia);
    destruct (Z.sgn_spec (det c d f)) as [[? ->] | [[? ->] | [? ->]]]; reflexivity || nia.
Qed.

(* Where the surface folds back at the edge, none or both. *)
Theorem folded_edge_is_crossed_evenly c d e f :
  passes_within c d -> on_one_side c d e f -> crosses c d e = crosses c d f.
Proof.
  intros Within Side. unfold on_one_side in Side.
  rewrite !crosses_at_edge by (assumption || nia). f_equal. nia.
Qed.

(* Wherever the line passes, also at an end of the edge: never both. *)
Theorem never_both_sides c d e f : on_both_sides c d e f -> crosses c d e && crosses c d f = false.
Proof.
  intro Sides. unfold on_both_sides in Sides. unfold crosses.
  assert (Z.sgn (det c d e) <> Z.sgn (det c d f)) by nia.
  destruct (Z.eqb_spec (side c d) (Z.sgn (det c d e))) as [Is |]; [| rewrite !andb_false_r; reflexivity].
  destruct (Z.eqb_spec (side c d) (Z.sgn (det c d f))); [congruence |]. rewrite !andb_false_r. reflexivity.
Qed.

(* A line through the end c of an edge may cross neither of its triangles: the third of the corner is crossed. *)
Definition place (a b : Z) : Place := {| A := a; B := b |}.
Theorem corner_may_be_left :
  let c := place 0 0 in
  let d := place (-1) (-1) in
  let e := place 1 0 in
  let f := place 0 1 in
  edge c d = 0 /\ on_both_sides c d e f /\
  crosses c d e = false /\ crosses c d f = false /\ crosses c e f = true.
Proof. repeat split. Qed.
