(* int_major_pair, in integers: on the way from the root to a leaf it never misses a box that holds a common
   point. A node's planes and owners need only be right for the faces that a child owns. *)
From Coq Require Import ZArith QArith Qabs Qround List Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor SetUp NeverMisses.
Import ListNotations.
Open Scope Z_scope.

(* hls/box/int_major_pair_operands.hpp: who has a plane that differs from the parent's. true: the second. *)
Record PlaneOwners := {
  own_xmin : bool; own_xmax : bool; own_ymin : bool; own_ymax : bool; own_zmin : bool; own_zmax : bool
}.

Record PairNode := { node_planes : MajorPlanes; node_owners : PlaneOwners }.

(* hls/pipelines/int_major_pair.hpp: a distance that does not bind, where the plane is not the box's own. *)
Definition greatest_distance f : Z := 2 ^ (distance f - 1) - 1.
Definition own_near (own : bool) (t : Z) : Z := if own then t else 0.
Definition own_far f (own : bool) (t : Z) : Z := if own then t else greatest_distance f.

Definition own_interval f (ray : MajorRay) (node : PairNode) (second : bool) (parent : NearFar Z) :
    NearFar Z :=
  let planes := node_planes node in
  let owners := node_owners node in
  let t := plane_distances f ray planes in
  let low := to_ray_axes ray (own_xmin owners) (own_ymin owners) (own_zmin owners) in
  let high := to_ray_axes ray (own_xmax owners) (own_ymax owners) (own_zmax owners) in
  let own_by owner := eqb owner second in
  let own_m := in_ray_order (back_m ray) (m low) (m high) in
  let own_a := in_ray_order (back_a ray) (a low) (a high) in
  let own_b := in_ray_order (back_b ray) (b low) (b high) in
  let near_of own t := own_near (own_by (near own)) (near t) in
  let far_of own t := own_far f (own_by (far own)) (far t) in
  {| near := Z.max (Z.max (near_of own_m (m t)) (near_of own_a (a t)))
                   (Z.max (near_of own_b (b t)) (near parent));
     far := Z.min (Z.min (far_of own_m (m t)) (far_of own_a (a t)))
                  (Z.min (far_of own_b (b t)) (far parent)) |}.

Definition hit_of_pair (interval : NearFar Z) : bool := near interval <=? far interval.

(* The planes that a child owns are its own. *)
Definition owns_right_planes (node : PairNode) (second : bool) (child : MajorPlanes) : Prop :=
  let o := node_owners node in
  let p := node_planes node in
  (own_xmin o = second -> xmin p = xmin child) /\ (own_xmax o = second -> xmax p = xmax child) /\
  (own_ymin o = second -> ymin p = ymin child) /\ (own_ymax o = second -> ymax p = ymax child) /\
  (own_zmin o = second -> zmin p = zmin child) /\ (own_zmax o = second -> zmax p = zmax child).

(* A step down the tree: a node, and which child. *)
Record Step := { step_node : PairNode; step_second : bool }.

(* All boxes on the path are hit. Each gets its parent's interval. *)
Fixpoint reaches f (ray : MajorRay) (path : list Step) (parent : NearFar Z) : bool :=
  match path with
  | [] => true
  | step :: rest =>
      let interval := own_interval f ray (step_node step) (step_second step) parent in
      hit_of_pair interval && reaches f ray rest interval
  end.

Lemma length_below_greatest f : valid f -> largest_length f <= greatest_distance f.
Proof.
  intros []. unfold greatest_distance, largest_length, distance.
  apply Z.sub_le_mono_r. apply Z.pow_le_mono_r; lia.
Qed.

(* ---- In both worlds ---- *)

Local Opaque major_distance scaled_distance difference eqb greatest_distance.

(* If the child's own slabs and the parent's interval hold D, so does the child's interval. *)
Theorem interval_keeps_distance f ray node second child parent D :
  owns_right_planes node second child -> slabs_hold f ray child D ->
  near parent <= D <= far parent -> 0 <= D <= greatest_distance f ->
  let interval := own_interval f ray node second parent in
  near interval <= D <= far interval.
Proof.
  cbv zeta. intros [X0 [X1 [Y0 [Y1 [Z0 Z1]]]]] [[NearM FarM] [[NearA FarA] [NearB FarB]]] Parent Range.
  unfold own_interval, own_near, own_far. destruct ray.
  destruct major_y, major_z; cbn in *;
    (split; [repeat apply Z.max_lub | repeat apply Z.min_glb]); try apply Parent;
    match goal with |- context [if ?back then _ else _] => is_var back; destruct back end;
    match goal with
    | |- context [eqb ?owner second] => destruct (eqb owner second) eqn:Own; [apply eqb_prop in Own | lia]
    end;
    first [rewrite (X0 Own) | rewrite (X1 Own) | rewrite (Y0 Own) | rewrite (Y1 Own) | rewrite (Z0 Own)
          | rewrite (Z1 Own)]; assumption.
Qed.

(* Each child on the path has planes whose slabs hold D, and owns them rightly. *)
Definition path_holds f ray (path : list Step) (D : Z) : Prop :=
  forall step, In step path ->
    exists child, owns_right_planes (step_node step) (step_second step) child /\ slabs_hold f ray child D.

Theorem path_is_reached f ray path parent D :
  path_holds f ray path D -> near parent <= D <= far parent -> 0 <= D <= greatest_distance f ->
  reaches f ray path parent = true.
Proof.
  intros Path Parent Range. revert parent Parent.
  induction path as [| step rest IH]; intros parent Parent; [reflexivity |].
  destruct (Path step (or_introl eq_refl)) as [child [Right Slabs]].
  pose proof (interval_keeps_distance f ray (step_node step) (step_second step) child parent D
                Right Slabs Parent Range) as Kept.
  cbv zeta in Kept. cbn [reaches]. cbv zeta. apply andb_true_iff. split.
  - unfold hit_of_pair. apply Z.leb_le. lia.
  - apply IH; [| exact Kept]. intros s InRest. apply Path. right. exact InRest.
Qed.

(* ---- The float world ---- *)

(* The point of the ray at t is in the box. *)
Definition inside (box : Box) (ray : Ray) (t : Q) : Prop :=
  forall k, (lo box k <= origin ray k + t * direction ray k <= hi box k)%Q.

Theorem interval_keeps_point f major ray t node second box parent :
  valid f -> slope f = 0 -> is_major major ray -> acceptable_ray ray -> (0 <= t)%Q ->
  acceptable_box box -> owns_right_planes node second (quantise_box f box) -> inside box ray t ->
  let D := as_distance f (scale f * (t * Qabs (direction ray major))) in
  near parent <= D <= far parent -> 0 <= D <= greatest_distance f ->
  let interval := own_interval f (set_up f major ray) node second parent in
  near interval <= D <= far interval.
Proof.
  intros. apply interval_keeps_distance with (quantise_box f box); try assumption.
  apply float_slabs_hold; assumption.
Qed.

(* From the root, whose interval starts at 0 and ends with the ray, every box on the path is hit. *)
Theorem pair_never_misses :
  forall (f : Format) (major : Axis) (ray : Ray) (path : list Step) (t : Q),
    valid f -> slope f = 0 -> is_major major ray -> acceptable_ray ray ->
    (forall step, In step path ->
       exists box, acceptable_box box /\ inside box ray t /\
         owns_right_planes (step_node step) (step_second step) (quantise_box f box)) ->
    (0 <= t)%Q -> (forall l, length ray = Some l -> (t <= l)%Q) ->
    let r := set_up f major ray in
    reaches f r path {| near := 0; far := len r |} = true.
Proof.
  intros f major ray path t V Float Major RayOk Path Start End. cbv zeta.
  destruct path as [| first rest]; [reflexivity |].
  set (T := (scale f * (t * Qabs (direction ray major)))%Q).
  assert (0 <= as_distance f T) as Ahead.
  { apply as_distance_not_negative. apply (T_positive f major ray t V Start). }
  assert (as_distance f T <= len (set_up f major ray)) as Within.
  { destruct (Path first (or_introl eq_refl)) as [box [BoxOk [Inside _]]].
    exact (below_length f _ (length ray) t V (Qabs_nonneg _) Start
             (T_in_cube f major ray box t V RayOk BoxOk Start Inside) End). }
  assert (len (set_up f major ray) <= greatest_distance f) as Largest.
  { apply Z.le_trans with (largest_length f).
    - apply length_word_at_most.
    - apply length_below_greatest. exact V. }
  apply path_is_reached with (as_distance f T); [| cbn [near far]; lia | lia].
  intros step InPath. destruct (Path step InPath) as [box [BoxOk [Inside Right]]].
  exists (quantise_box f box). split; [exact Right |]. apply float_slabs_hold; assumption.
Qed.
