(* A line crosses a closed mesh an even number of times, and an oriented one as often from either side.

   A mesh is a list of triangles, each three corners of any type. It is closed if every edge belongs to an even
   number of triangles. It is oriented too if every edge occurs as often in one sense as in the other. Triangles
   may meet anywhere, fold, repeat, be seen edge-on or have no area. Crossing.v says what one triangle counts. *)
From Coq Require Import ZArith Lia Bool List.
From HitpipeMajor Require Import Crossing.
Import ListNotations.
Open Scope Z_scope.

Section Mesh.
Variables (Corner : Type) (same : forall c d : Corner, {c = d} + {c <> d}).

Definition Edge : Type := Corner * Corner.
Definition Triangle : Type := Corner * Corner * Corner.

Definition same_edge (e f : Edge) : {e = f} + {e <> f}.
Proof. decide equality. Defined.

Definition edges_of (t : Triangle) : list Edge := let '(c, d, e) := t in [(c, d); (d, e); (e, c)].
Definition edges (mesh : list Triangle) : list Edge := flat_map edges_of mesh.

(* How often an edge occurs in this sense. *)
Definition times (l : list Edge) (c d : Corner) : nat := count_occ same_edge l (c, d).

Definition closed (mesh : list Triangle) : Prop :=
  forall c d, c <> d -> Nat.Even (times (edges mesh) c d + times (edges mesh) d c).
Definition closed_and_oriented (mesh : list Triangle) : Prop :=
  forall c d, c <> d -> times (edges mesh) c d = times (edges mesh) d c.

(* ---- Sums ---- *)

Definition total {T} (w : T -> Z) (l : list T) : Z := fold_right (fun x sum => w x + sum) 0 l.

Lemma total_of_both {T} (w : T -> Z) k l : total w (k ++ l) = total w k + total w l.
Proof.
  induction k as [| x k IH]; cbn; [reflexivity |]. fold (total w (k ++ l)) (total w k).
  rewrite IH. ring.
Qed.

Lemma total_of_parts {T} (w : T -> Z) part l :
  total w l = total w (filter part l) + total w (filter (fun x => negb (part x)) l).
Proof.
  induction l as [| x l IH]; [reflexivity |]. cbn. fold (total w l). rewrite IH.
  destruct (part x); cbn; unfold total; ring.
Qed.

Lemma filter_is_not_longer {T} (part : T -> bool) l : (length (filter part l) <= length l)%nat.
Proof using. induction l as [| x l IH]; cbn; [| destruct (part x); cbn]; lia. Qed.

(* How much more often an edge occurs in this sense than in the other. *)
Definition surplus (l : list Edge) (c d : Corner) : Z := Z.of_nat (times l c d) - Z.of_nat (times l d c).

(* The edge c d in either sense. *)
Definition joins (c d : Corner) (e : Edge) : bool :=
  if same_edge e (c, d) then true else if same_edge e (d, c) then true else false.

(* A weight of edges that changes its sign with the edge's sense. *)
Section Sum.
Variables (w : Edge -> Z) (k : Z).
Hypothesis turned : forall c d, w (d, c) = - w (c, d).

Lemma total_of_edge c d l : total w (filter (joins c d) l) = surplus l c d * w (c, d).
Proof using turned.
  pose proof (turned c d) as Turned. unfold surplus, times.
  induction l as [| e l IH]; [reflexivity |]. cbn [filter count_occ]. unfold joins at 1.
  destruct (same_edge e (c, d)) as [-> | _]; destruct (same_edge _ (d, c)) as [Both |]; cbn [total fold_right];
    fold (total w (filter (joins c d) l)); rewrite ?IH, ?Nat2Z.inj_succ.
  - injection Both. intros. subst d. lia.
  - ring.
  - subst e. rewrite Turned. ring.
  - ring.
Qed.

Lemma times_without c d l a b :
  times (filter (fun e => negb (joins c d e)) l) a b = if joins c d (a, b) then 0%nat else times l a b.
Proof using.
  unfold times. induction l as [| e l IH]; [cbn; destruct (joins c d (a, b)); reflexivity |].
  cbn [filter count_occ]. destruct (same_edge e (a, b)) as [-> | Other].
  - destruct (joins c d (a, b)) eqn:Joins; cbn [negb]; [exact IH |].
    cbn [count_occ]. destruct (same_edge (a, b) (a, b)); [| congruence]. rewrite IH. reflexivity.
  - destruct (joins c d e); cbn [negb]; [exact IH |].
    cbn [count_occ]. destruct (same_edge e (a, b)); [congruence |]. exact IH.
Qed.

Lemma joins_turned c d a b : joins c d (b, a) = joins c d (a, b).
Proof using.
  unfold joins. destruct (same_edge (b, a) (c, d)), (same_edge (b, a) (d, c)), (same_edge (a, b) (c, d)),
    (same_edge (a, b) (d, c)); congruence.
Qed.

(* If k divides the surplus of each edge, it divides the sum. *)
Lemma total_of_edges l : (forall c d, c <> d -> (k | surplus l c d)) -> (k | total w l).
Proof using turned.
  intro Apart.
  assert (forall c d, (k | surplus l c d)) as Divides; [| clear Apart].
  { intros c d. destruct (same c d) as [-> |]; [| auto]. unfold surplus. rewrite Z.sub_diag. apply Z.divide_0_r. }
  revert Divides. remember (length l) as n eqn:Length. revert l Length.
  induction n as [n IH] using lt_wf_ind. intros l Length Divides.
  destruct l as [| [c d] l]; [apply Z.divide_0_r |].
  rewrite (total_of_parts w (joins c d)). apply Z.divide_add_r.
  - rewrite total_of_edge. apply Z.divide_mul_l. apply Divides.
  - apply IH with (length (filter (fun e => negb (joins c d e)) ((c, d) :: l))); [| reflexivity |].
    + subst n. cbn [filter length]. unfold joins at 1. destruct (same_edge (c, d) (c, d)); [| congruence].
      cbn [negb].
      pose proof (filter_is_not_longer (fun e => negb (joins c d e)) l). lia.
    + intros a b. unfold surplus. rewrite !times_without, (joins_turned c d a b).
      destruct (joins c d (a, b)); [apply Z.divide_0_r | apply Divides].
Qed.
End Sum.

Lemma surplus_of_closed mesh c d : closed mesh -> c <> d -> (2 | surplus (edges mesh) c d).
Proof using.
  intros Closed Apart. destruct (Closed c d Apart) as [h H]. unfold surplus.
  exists (Z.of_nat h - Z.of_nat (times (edges mesh) d c)). lia.
Qed.

(* ---- The line ---- *)

(* Where the corners are, as seen along the line. *)
Variable place : Corner -> Place.

Definition is_crossed (t : Triangle) : bool := let '(c, d, e) := t in crosses (place c) (place d) (place e).
Definition sign_of (t : Triangle) : Z := let '(c, d, e) := t in crossing_sign (place c) (place d) (place e).
Definition through_edge (e : Edge) : Z := through (place (fst e)) (place (snd e)).

Lemma total_of_triangles mesh : total sign_of mesh = total through_edge (edges mesh).
Proof using.
  induction mesh as [| [[c d] e] mesh IH]; [reflexivity |].
  unfold edges. cbn [flat_map]. rewrite total_of_both. fold (edges mesh).
  rewrite <- IH. cbn. unfold through_edge. cbn [fst snd].
  rewrite <- triangle_edges. unfold total. ring.
Qed.

Lemma sum_of_signs mesh k : (forall c d, c <> d -> (k | surplus (edges mesh) c d)) -> (k | total sign_of mesh).
Proof using.
  intro Divides. rewrite total_of_triangles. apply total_of_edges; [| exact Divides].
  intros c d. apply through_turned.
Qed.

(* The headline. *)
Theorem closed_mesh_is_crossed_evenly mesh : closed mesh -> Nat.Even (length (filter is_crossed mesh)).
Proof using.
  intro Closed.
  assert (2 | total sign_of mesh) as [half Half].
  { apply sum_of_signs. intros c d. apply surplus_of_closed. exact Closed. }
  assert (exists h, total sign_of mesh - Z.of_nat (length (filter is_crossed mesh)) = h * 2) as [rest Rest].
  { clear. induction mesh as [| [[c d] e] mesh [h IH]]; [exists 0; reflexivity |].
    cbn [filter is_crossed]. cbn [total fold_right sign_of]. fold (total sign_of mesh).
    unfold crossing_sign. destruct (crosses (place c) (place d) (place e)) eqn:Crosses.
    - cbn [length]. pose proof (crossing_sign_is (place c) (place d) (place e)) as Sign.
      unfold crossing_sign in Sign. rewrite Crosses in Sign.
      destruct Sign as [-> | [-> | [_ Not]]]; [exists h | exists (h - 1) | discriminate]; lia.
    - exists h. lia. }
  exists (Z.to_nat (half - rest)). lia.
Qed.

(* An oriented mesh is crossed from the front as often as from the back. *)
Theorem oriented_mesh_is_crossed_evenly mesh :
  closed_and_oriented mesh ->
  length (filter (fun t => sign_of t =? 1) mesh) = length (filter (fun t => sign_of t =? -1) mesh).
Proof using.
  intro Closed.
  assert (0 | total sign_of mesh) as [zero Zero].
  { apply sum_of_signs. intros c d Apart. unfold surplus.
    rewrite (Closed c d Apart), Z.sub_diag. apply Z.divide_0_r. }
  assert (total sign_of mesh = Z.of_nat (length (filter (fun t => sign_of t =? 1) mesh)) -
                               Z.of_nat (length (filter (fun t => sign_of t =? -1) mesh))) as Counts.
  { clear. induction mesh as [| [[c d] e] mesh IH]; [reflexivity |].
    cbn [filter]. cbn [total fold_right]. fold (total sign_of mesh). rewrite IH. cbn [sign_of].
    destruct (crossing_sign_is (place c) (place d) (place e)) as [-> | [-> | [-> _]]];
      cbn [Z.eqb Pos.eqb length]; lia. }
  lia.
Qed.
End Mesh.
