(* What the proof needs is needed: two rays in 20+1/13, the program's format, that a weaker rule misses.
   Both rays and boxes are binary32 numbers. They are checked by computation. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Lqa.
From HitpipeMajor Require Import Numbers IntMajor.
Open Scope Z_scope.

Definition program_format : Format := {| coord := 20; finer := 1; mantissa := 13; fraction := 0 |}.

Definition vector (cx cy cz : Q) (k : Axis) : Q := match k with x => cx | y => cy | z => cz end.

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
