(* The numbers of the exact triangle test in the integer world: what they are, and how wide. TriangleHit.v
   proves that they decide the hit. *)
From Coq Require Import ZArith Lia.
From HitpipeMajor Require Import Numbers IntMajor IntegerTriangle.
Open Scope Z_scope.

Definition Vector := Axis -> Z.
Definition minus (p q : Vector) : Vector := fun k => p k - q k.
Definition dot (p q : Vector) : Z := p x * q x + p y * q y + p z * q z.
Definition cross (p q : Vector) : Vector := fun k =>
  match k with
  | x => p y * q z - p z * q y
  | y => p z * q x - p x * q z
  | z => p x * q y - p y * q x
  end.

(* ---- The numbers ---- *)

(* Origin o on the fine grid, 2^g to a corner's unit; direction d. The identities hold in any order of axes. *)
Section Numbers.
Variables (g : Z) (t : Corners) (o d : Vector).

Definition edge1 : Vector := minus (corner1 t) (corner0 t).
Definition edge2 : Vector := minus (corner2 t) (corner0 t).
Definition fine_corner (v : Vector) : Vector := fun k => 2 ^ g * v k - o k.
Definition to_corner0 : Vector := fine_corner (corner0 t).
Definition across : Vector := cross d edge2.            (* P *)
Definition aside : Vector := cross to_corner0 edge1.    (* Q *)

Definition det : Z := dot edge1 across.
Definition u : Z := dot to_corner0 across.
Definition v : Z := dot d aside.
Definition num : Z := dot edge2 aside.
Definition e0 : Z := 2 ^ g * det + u + v.

Ltac polynomial :=
  unfold e0, num, v, u, det, aside, across, to_corner0, fine_corner, edge1, edge2, minus, dot; cbn [cross];
  set (fine := 2 ^ g); ring.

(* The determinant of d and the two ends of each edge. *)
Theorem edge_determinant_0 :
  dot d (cross (fine_corner (corner1 t)) (fine_corner (corner2 t))) = - (2 ^ g * e0).
Proof. polynomial. Qed.
Theorem edge_determinant_1 : dot d (cross (fine_corner (corner2 t)) (fine_corner (corner0 t))) = 2 ^ g * u.
Proof. polynomial. Qed.
Theorem edge_determinant_2 : dot d (cross (fine_corner (corner0 t)) (fine_corner (corner1 t))) = 2 ^ g * v.
Proof. polynomial. Qed.

(* Their sum is 2^(2g) det, up to its sign. *)
Theorem edge_determinants_sum : - (2 ^ g * e0) + 2 ^ g * u + 2 ^ g * v = - (2 ^ g * 2 ^ g * det).
Proof. polynomial. Qed.

(* The way from origin to corner 0 in edges and direction. *)
Theorem to_corner0_is k : det * to_corner0 k = u * edge1 k + v * edge2 k - num * d k.
Proof. destruct k; polynomial. Qed.

(* The point o - num / det d lies in the triangle's plane. *)
Theorem point_in_plane :
  dot (cross edge1 edge2) (fun k => det * o k - num * d k - det * (2 ^ g * corner0 t k)) = 0.
Proof. polynomial. Qed.
End Numbers.

(* ---- Widths ---- *)

Definition within (limit : Z) (p : Vector) : Prop := forall k, Z.abs (p k) <= limit.

Definition are_signs (s : Vector) : Prop := forall k, s k = 1 \/ s k = -1.

Lemma signs_of p : exists s, are_signs s /\ Z.abs (p x) + Z.abs (p y) + Z.abs (p z) = dot s p.
Proof.
  exists (fun k => if p k <? 0 then -1 else 1). split.
  - intro k. destruct (p k <? 0); [right | left]; reflexivity.
  - unfold dot.
    destruct (Z.ltb_spec (p x) 0), (Z.ltb_spec (p y) 0), (Z.ltb_spec (p z) 0); lia.
Qed.

Lemma cross_with_signs C r s :
  within C r -> are_signs s ->
  Z.abs (cross r s x) + Z.abs (cross r s y) + Z.abs (cross r s z) <= 4 * C.
Proof.
  intros R S. pose proof (R x). pose proof (R y). pose proof (R z). cbn [cross].
  destruct (S x) as [-> | ->], (S y) as [-> | ->], (S z) as [-> | ->]; lia.
Qed.

Lemma dot_below A p q :
  within A p -> Z.abs (dot p q) <= A * (Z.abs (q x) + Z.abs (q y) + Z.abs (q z)).
Proof.
  intro P. unfold dot.
  assert (forall k, Z.abs (p k * q k) <= A * Z.abs (q k)) as Each.
  { intro k. rewrite Z.abs_mul. apply Z.mul_le_mono_nonneg_r; [apply Z.abs_nonneg | apply P]. }
  pose proof (Each x). pose proof (Each y). pose proof (Each z). lia.
Qed.

(* A determinant whose rows are within A, B and C. It is largest where all its entries are. *)
Theorem determinant_below A B C p q r :
  within A p -> within B q -> within C r -> Z.abs (dot p (cross q r)) <= 4 * (A * B * C).
Proof.
  intros P Q R. pose proof (Z.abs_nonneg (p x)). pose proof (P x). pose proof (Q x). pose proof (R x).
  destruct (signs_of (cross q r)) as [s [S Sum]].
  pose proof (dot_below A p (cross q r) P) as Outer. rewrite Sum in Outer.
  assert (dot s (cross q r) = dot q (cross r s)) as Turned by (unfold dot; cbn [cross]; ring).
  pose proof (dot_below B q (cross r s) Q) as Inner. pose proof (cross_with_signs C r s R S) as Signs.
  apply Z.le_trans with (A * (B * (4 * C))); [| lia]. apply Z.le_trans with (1 := Outer).
  apply Z.mul_le_mono_nonneg_l; [lia |]. rewrite Turned.
  apply Z.le_trans with (Z.abs (dot q (cross r s))); [lia |].
  apply Z.le_trans with (1 := Inner). apply Z.mul_le_mono_nonneg_l; lia.
Qed.

Record triangle_in_cube f (t : Corners) (o d : Vector) : Prop := {
  corners_in_cube : within (largest_point f) (corner0 t) /\ within (largest_point f) (corner1 t) /\
                    within (largest_point f) (corner2 t);
  origin_in_fine_cube : within (largest_point f * 2 ^ finer f) o;
  direction_fits : within (2 ^ slope f) d
}.

Section Widths.
Variables (f : Format) (t : Corners) (o d : Vector).
Hypotheses (V : valid f) (Slope : 0 <= slope f) (Cube : triangle_in_cube f t o d).

Let g := finer f.

Lemma edges_within : within (2 ^ (coord f - 1) - 1) (edge1 t) /\ within (2 ^ (coord f - 1) - 1) (edge2 t).
Proof using V Cube.
  destruct Cube as [[C0 [C1 C2]] _ _], V. unfold edge1, edge2, minus, largest_point in *.
  pose proof (twice_power (coord f - 1) ltac:(lia)) as Twice.
  replace (coord f - 1 - 1) with (coord f - 2) in Twice by lia.
  split; intro k; pose proof (C0 k); pose proof (C1 k); pose proof (C2 k); lia.
Qed.

Lemma fine_corner_within c :
  within (largest_point f) c -> within (2 ^ (coord f + g - 1) - 1) (fine_corner g o c).
Proof using V Cube.
  destruct Cube as [_ O _], V. intros C k. specialize (O k). specialize (C k).
  unfold fine_corner, g, largest_point in *.
  pose proof (power_positive (finer f) ltac:(lia)). pose proof (power_positive (coord f - 2) ltac:(lia)).
  replace (coord f + finer f - 1) with (coord f - 2 + 1 + finer f) by lia.
  rewrite !power_sum by lia. change (2 ^ 1) with 2.
  assert (Z.abs (2 ^ finer f * c k) <= 2 ^ finer f * (2 ^ (coord f - 2) - 1)) by (rewrite Z.abs_mul; nia).
  nia.
Qed.

(* 4 A B C, with A and C below powers of two. *)
Lemma product_below B a b c product :
  1 <= a -> 0 <= b -> 1 <= c -> 0 < B <= 2 ^ b -> product = (2 ^ a - 1) * B * (2 ^ c - 1) ->
  4 * product < 2 ^ (a + b + c + 2).
Proof.
  intros. subst product. rewrite !power_sum by lia. change (2 ^ 2) with 4.
  pose proof (power_monotone 1 a ltac:(lia)). pose proof (power_monotone 1 c ltac:(lia)).
  pose proof (power_positive b ltac:(lia)). change (2 ^ 1) with 2 in *.
  assert ((2 ^ a - 1) * B * (2 ^ c - 1) < 2 ^ a * 2 ^ b * 2 ^ c); [| lia].
  assert ((2 ^ a - 1) * B < 2 ^ a * 2 ^ b) by nia. nia.
Qed.

Let n := coord f.
Let S := slope f.

(* u, v, e0 and num in words of one bit more, for the sign. *)
Theorem numbers_fit :
  Z.abs (det t d) < 2 ^ (2 * n + S) /\
  Z.abs (u g t o d) < 2 ^ (2 * n + g + S) /\ Z.abs (v g t o d) < 2 ^ (2 * n + g + S) /\
  Z.abs (e0 g t o d) < 2 ^ (2 * n + g + S) /\ Z.abs (num g t o) < 2 ^ (3 * n + g - 1).
Proof using V Slope Cube.
  destruct edges_within as [E1 E2]. destruct Cube as [[C0 [C1 C2]] _ D].
  pose proof (fine_corner_within _ C0) as W0. pose proof (fine_corner_within _ C1) as W1.
  pose proof (fine_corner_within _ C2) as W2.
  assert (2 <= n /\ 0 <= g) as [N G] by (destruct V; split; assumption).
  pose proof (power_positive S ltac:(assumption)) as PowerS.
  fold n in E1, E2, W0, W1, W2. fold S in D.
  unfold det, u, v, num, across, aside, to_corner0. repeat split.
  - apply Z.le_lt_trans with (1 := determinant_below _ _ _ _ _ _ E1 D E2).
    replace (2 * n + S) with (n - 1 + S + (n - 1) + 2) by lia.
    apply product_below with (2 ^ S); (lia || ring).
  - apply Z.le_lt_trans with (1 := determinant_below _ _ _ _ _ _ W0 D E2).
    replace (2 * n + g + S) with (n + g - 1 + S + (n - 1) + 2) by lia.
    apply product_below with (2 ^ S); (lia || ring).
  - apply Z.le_lt_trans with (1 := determinant_below _ _ _ _ _ _ D W0 E1).
    replace (2 * n + g + S) with (n + g - 1 + S + (n - 1) + 2) by lia.
    apply product_below with (2 ^ S); (lia || ring).
  - pose proof (determinant_below _ _ _ _ _ _ D W1 W2) as Bound. rewrite edge_determinant_0 in Bound.
    assert (4 * (2 ^ S * (2 ^ (n + g - 1) - 1) * (2 ^ (n + g - 1) - 1)) <
            2 ^ (n + g - 1 + S + (n + g - 1) + 2)) as Below
      by (apply product_below with (2 ^ S); (lia || ring)).
    replace (n + g - 1 + S + (n + g - 1) + 2) with (g + (2 * n + g + S)) in Below by lia.
    rewrite (power_sum g) in Below by lia. rewrite Z.abs_opp, Z.abs_mul in Bound.
    pose proof (power_positive g G). rewrite (Z.abs_eq (2 ^ g)) in Bound by lia. nia.
  - apply Z.le_lt_trans with (1 := determinant_below _ _ _ _ _ _ E2 W0 E1).
    replace (3 * n + g - 1) with (n - 1 + (n + g - 1) + (n - 1) + 2) by lia.
    apply product_below with (2 ^ (n + g - 1) - 1); [lia | lia | lia | | ring].
    pose proof (power_monotone 1 (n + g - 1) ltac:(lia)). change (2 ^ 1) with 2 in *. lia.
Qed.
End Widths.
