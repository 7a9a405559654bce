(* What the proof needs is needed: rays in the program's formats that a weaker rule misses. The floats are
   binary32 numbers. All are checked by computation. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa Bool List.
From HitpipeMajor Require Import Numbers IntMajor NeverMisses IntegerWorld.
From HitpipeMajor Require Crossing CrossingMesh.
Import ListNotations.
Open Scope Z_scope.

Definition program_format : Format := {| coord := 20; finer := 1; mantissa := 13; fraction := 0; slope := 0 |}.

Definition by_axis {X} (of_x of_y of_z : X) (k : Axis) : X := match k with x => of_x | y => of_y | z => of_z end.
Definition vector : Q -> Q -> Q -> Axis -> Q := by_axis.

(* An endless ray along x, which enters at x = -1, and a box that is one point of it. *)
Definition along_x (height : Q) : Ray :=
  {| origin := vector (-(1)) height 0; direction := vector 1 0 0; length := None |}.
Definition point_box (height : Q) : Box := {| lo := vector 1 height 0; hi := vector 1 height 0 |}.

Lemma along_x_meets height : meets (along_x height) (point_box height).
Proof. exists 2%Q. split; [lra |]. split; [discriminate |]. intros []; cbn; lra. Qed.

(* With the exponent capped at n + g - 2 the far distance of a difference of 1 ends before the cube does. *)
Theorem smaller_cap_misses :
  let f := program_format in
  let ray := along_x (1 # 2 ^ 19) in
  let box := point_box (1 # 2 ^ 19) in
  meets ray box /\ test f (set_up_to (largest_exponent f - 1) f x ray) (quantise_box f box) = false.
Proof. split; [apply along_x_meets | vm_compute; reflexivity]. Qed.

(* The same operands with another word for the origin in ray axis a. *)
Definition with_origin_a (o : Z) (r : MajorRay) : MajorRay :=
  {| major_y := major_y r; major_z := major_z r;
     back_m := back_m r; back_a := back_a r; back_b := back_b r;
     origin_m := origin_m r; origin_a := o; origin_b := origin_b r;
     floor_a := floor_a r; ceil_a := ceil_a r; floor_b := floor_b r; ceil_b := ceil_b r;
     exp_a := exp_a r; exp_b := exp_b r; len := len r |}.

(* If a tie goes up, the far plane is at distance 0 although the ray never leaves the slab. *)
Theorem tie_upward_misses :
  let f := program_format in
  let ray := along_x (1 # 4) in
  let box := point_box (1 # 4) in
  let upward := Qfloor (on_fine_grid f (origin ray y) + (1 # 2)) in
  meets ray box /\
  (Qabs (inject_Z upward - on_fine_grid f (origin ray y)) == 1 # 2)%Q /\
  test f (with_origin_a upward (set_up f x ray)) (quantise_box f box) = false.
Proof. split; [apply along_x_meets |]. split; vm_compute; reflexivity. Qed.

(* ---- The integer world ---- *)

Definition integer_format : Format :=
  {| coord := 20; finer := 1; mantissa := 11; fraction := 0; slope := 20 |}.

(* Along x from 0, in the face y = 100 of a box that begins at x = 10. *)
Definition ray_in_face : IntegerRay :=
  {| start := by_axis 0 200 0; backward := fun _ => false; slopes := by_axis (2 ^ 20) 0 0; cut := 1000 |}.
Definition box_with_face : IntegerBox := {| lo_face := by_axis 10 (-5) (-5); hi_face := by_axis 20 100 5 |}.

(* Without the carry the ray leaves the face where it begins. *)
Theorem no_carry_misses :
  let f := integer_format in
  let ray := ray_in_face in
  let box := box_with_face in
  acceptable_integer_ray f x ray /\ acceptable_integer_box f box /\
  holds_point f box (point_at f ray 20) /\ as_distance f 20 <= cut ray /\
  integer_hit f x ray box = true /\
  test_with 0 f (integer_set_up f x ray) (integer_planes box) = false.
Proof.
  cbv zeta. split; [| split; [| split; [| split; [| split; vm_compute; reflexivity]]]].
  - constructor; [intros [] | | intros []]; vm_compute; repeat split; discriminate.
  - intros []; split; vm_compute; discriminate.
  - intros []; split; vm_compute; discriminate.
  - vm_compute. discriminate.
Qed.

(* ---- Exactly once ---- *)

(* A line through an edge of a tetrahedron that hits a third face, as seen along the line. *)
Section Ties.
Let place (corner : nat) : Crossing.Place :=
  match corner with
  | 0%nat => {| Crossing.A := -1; Crossing.B := 0 |}
  | 1%nat => {| Crossing.A := 1; Crossing.B := 0 |}
  | 2%nat => {| Crossing.A := 0; Crossing.B := 1 |}
  | _ => {| Crossing.A := 1; Crossing.B := -1 |}
  end.
Let tetrahedron : list (nat * nat * nat) := [(0, 2, 1); (0, 1, 3); (0, 3, 2); (1, 2, 3)]%nat.

(* The rule with another answer where an edge's determinant is 0; an answer of 0 takes every such line. *)
Let hits_with (tie : Crossing.Place -> Crossing.Place -> Z) (t : nat * nat * nat) : bool :=
  let '(c, d, e) := t in
  let sign := Z.sgn (Crossing.det (place c) (place d) (place e)) in
  let agrees p q :=
    let here := Crossing.first_not_zero (Crossing.edge p q) (tie p q) 0 in (here =? 0) || (Z.sgn here =? sign) in
  negb (sign =? 0) && agrees (place d) (place e) && agrees (place e) (place c) && agrees (place c) (place d).

Theorem tetrahedron_is_closed : CrossingMesh.closed_and_oriented nat Nat.eq_dec tetrahedron.
Proof.
  intros c d _. do 4 (destruct c as [| c]; [do 4 (destruct d as [| d]; [reflexivity |]); reflexivity |]).
  do 4 (destruct d as [| d]; [reflexivity |]). reflexivity.
Qed.

(* The closed test counts three faces. So does a rule with one component of the edge alone. *)
Theorem closed_test_is_odd : List.length (filter (hits_with (fun _ _ => 0)) tetrahedron) = 3%nat.
Proof. reflexivity. Qed.
Theorem one_component_is_odd :
  List.length (filter (hits_with (fun p q => Crossing.B p - Crossing.B q)) tetrahedron) = 3%nat.
Proof. reflexivity. Qed.
Theorem both_components_are_even :
  List.length (filter (CrossingMesh.is_crossed nat place) tetrahedron) = 2%nat.
Proof. reflexivity. Qed.
End Ties.
