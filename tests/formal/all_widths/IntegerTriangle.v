(* A ray of the integer world that hits a triangle: every box that holds the corners is accepted, alone and on
   the way from the root. *)
From Coq Require Import ZArith QArith Qabs Qround List Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor NeverMisses IntegerWorld Datapath Ranges Pair.
Import ListNotations.
Open Scope Z_scope.

(* The corners of a triangle, in units of a corner. *)
Record Corners := { corner0 : Axis -> Z; corner1 : Axis -> Z; corner2 : Axis -> Z }.

Definition holds_corners (box : IntegerBox) (t : Corners) : Prop :=
  forall k, lo_face box k <= corner0 t k <= hi_face box k /\ lo_face box k <= corner1 t k <= hi_face box k /\
            lo_face box k <= corner2 t k <= hi_face box k.

(* A point of the closed triangle, on the fine grid: a mean of the corners with weights. *)
Definition in_triangle f (t : Corners) (point : Axis -> Q) : Prop :=
  exists w0 w1 w2 : Q,
    (0 <= w0)%Q /\ (0 <= w1)%Q /\ (0 <= w2)%Q /\ (w0 + w1 + w2 == 1)%Q /\
    forall k, (point k == pow2 (finer f) * (w0 * inject_Z (corner0 t k) + w1 * inject_Z (corner1 t k) +
                                            w2 * inject_Z (corner2 t k)))%Q.

(* The ray hits the triangle where it has moved T along the major axis. *)
Definition hits_triangle f (ray : IntegerRay) (t : Corners) (T : Q) : Prop :=
  (0 <= T)%Q /\ in_triangle f t (point_at f ray T).

Theorem triangle_in_box f t box point :
  valid f -> holds_corners box t -> in_triangle f t point -> holds_point f box point.
Proof.
  intros V Corners [w0 [w1 [w2 [P0 [P1 [P2 [Sum Point]]]]]]] k.
  rewrite (Point k), !inject_Z_mult, !pow2_integer by (destruct V; lia).
  destruct (Corners k) as [[L0 H0] [[L1 H1] [L2 H2]]]. rewrite Zle_Qle in L0, H0, L1, H1, L2, H2.
  pose proof (pow2_positive (finer f)).
  set (l := inject_Z (lo_face box k)) in *. set (h := inject_Z (hi_face box k)) in *.
  assert (w0 * (h - inject_Z (corner0 t k)) + w1 * (h - inject_Z (corner1 t k)) +
          w2 * (h - inject_Z (corner2 t k)) ==
          h * (w0 + w1 + w2) - (w0 * inject_Z (corner0 t k) + w1 * inject_Z (corner1 t k) +
                                w2 * inject_Z (corner2 t k)))%Q as High by ring.
  assert (w0 * (inject_Z (corner0 t k) - l) + w1 * (inject_Z (corner1 t k) - l) +
          w2 * (inject_Z (corner2 t k) - l) ==
          (w0 * inject_Z (corner0 t k) + w1 * inject_Z (corner1 t k) + w2 * inject_Z (corner2 t k)) -
          l * (w0 + w1 + w2))%Q as Low by ring.
  rewrite Sum in High, Low.
  set (p := (w0 * inject_Z (corner0 t k) + w1 * inject_Z (corner1 t k) + w2 * inject_Z (corner2 t k))%Q) in *.
  assert (l <= p <= h)%Q as [Below Above] by (split; nra).
  split; rewrite (Qmult_comm _ (pow2 _)); apply Qmult_le_l; assumption.
Qed.

(* The headline: no box on the way to a triangle that the ray hits is missed. *)
Theorem triangle_hit_is_accepted :
  forall (f : Format) (major : Axis) (ray : IntegerRay) (box : IntegerBox) (t : Corners) (T : Q),
    valid f -> 0 < slope f -> acceptable_integer_ray f major ray -> acceptable_integer_box f box ->
    holds_corners box t -> hits_triangle f ray t T -> as_distance f T <= cut ray <= largest_length f ->
    integer_hit_words f major ray box = true.
Proof.
  intros f major ray box t T V Integer RayOk BoxOk Corners [Start Hit] Cut.
  apply datapath_accepts_integer_hit with T; try assumption. apply triangle_in_box with t; assumption.
Qed.

(* ---- Two boxes at a time ---- *)

(* A step of int_major_pair with any parent's interval that holds the hit's distance. *)
Theorem pair_keeps_integer_hit f major ray T node second box parent :
  valid f -> 0 < slope f -> acceptable_integer_ray f major ray -> acceptable_integer_box f box ->
  (0 <= T)%Q -> holds_point f box (point_at f ray T) ->
  owns_right_planes node second (integer_planes box) ->
  near parent <= as_distance f T <= far parent -> as_distance f T <= greatest_distance f ->
  let interval := own_interval f (integer_set_up f major ray) node second parent in
  near interval <= as_distance f T <= far interval /\ hit_of_pair interval = true.
Proof.
  intros V Integer RayOk BoxOk Start Inside Right Parent Range. cbv zeta.
  pose proof (interval_keeps_distance f (integer_set_up f major ray) node second (integer_planes box) parent
                (as_distance f T) Right
                (integer_slabs_hold f major ray box T V Integer RayOk BoxOk Start Inside) Parent
                (conj (as_distance_not_negative f T Start) Range)) as Kept.
  split; [exact Kept |]. unfold hit_of_pair. apply Z.leb_le. cbv zeta in Kept. lia.
Qed.

(* From the root, whose interval is 0 .. cut, every box on the path to a hit is accepted. *)
Theorem pair_accepts_integer_hit :
  forall (f : Format) (major : Axis) (ray : IntegerRay) (path : list Step) (T : Q),
    valid f -> 0 < slope f -> acceptable_integer_ray f major ray ->
    (forall step, In step path ->
       exists box, acceptable_integer_box f box /\ holds_point f box (point_at f ray T) /\
         owns_right_planes (step_node step) (step_second step) (integer_planes box)) ->
    (0 <= T)%Q -> as_distance f T <= cut ray <= largest_length f ->
    reaches f (integer_set_up f major ray) path {| near := 0; far := cut ray |} = true.
Proof.
  intros f major ray path T V Integer RayOk Path Start Cut.
  pose proof (as_distance_not_negative f T Start) as Ahead. pose proof (length_below_greatest f V).
  apply path_is_reached with (as_distance f T); [| cbn [near far]; lia | lia].
  intros step InPath. destruct (Path step InPath) as [box [BoxOk [Inside Right]]].
  exists (integer_planes box). split; [exact Right |]. apply integer_slabs_hold; assumption.
Qed.

(* The same with a triangle: every box on the path holds its corners. *)
Theorem pair_accepts_triangle_hit :
  forall (f : Format) (major : Axis) (ray : IntegerRay) (path : list Step) (t : Corners) (T : Q),
    valid f -> 0 < slope f -> acceptable_integer_ray f major ray ->
    (forall step, In step path ->
       exists box, acceptable_integer_box f box /\ holds_corners box t /\
         owns_right_planes (step_node step) (step_second step) (integer_planes box)) ->
    hits_triangle f ray t T -> as_distance f T <= cut ray <= largest_length f ->
    reaches f (integer_set_up f major ray) path {| near := 0; far := cut ray |} = true.
Proof.
  intros f major ray path t T V Integer RayOk Path [Start Hit] Cut.
  apply pair_accepts_integer_hit with T; try assumption. intros step InPath.
  destruct (Path step InPath) as [box [BoxOk [Corners Right]]]. exists box.
  split; [exact BoxOk |]. split; [| exact Right]. apply triangle_in_box with t; assumption.
Qed.
