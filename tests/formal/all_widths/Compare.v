(* Compares the definition with what the C++ computes. emit_cases.cpp writes the cases. *)
From Coq Require Import ZArith QArith List Bool.
From HitpipeMajor Require Import IntMajor Datapath.
Import ListNotations.
Open Scope Z_scope.

Record Case := {
  format : Format;
  major : Axis;
  ray : Ray;
  box : Box;
  words : list Z;  (* the operands, in the order of IntMajorOperands *)
  answer : bool    (* HIT *)
}.

Definition operand_words (r : MajorRay) (p : MajorPlanes) : list Z :=
  [Z.b2z (major_y r); Z.b2z (major_z r); Z.b2z (back_m r); Z.b2z (back_a r); Z.b2z (back_b r);
   origin_m r; origin_a r; origin_b r; floor_a r; ceil_a r; floor_b r; ceil_b r; exp_a r; exp_b r; len r;
   xmin p; xmax p; ymin p; ymax p; zmin p; zmax p].

Fixpoint same (p q : list Z) : bool :=
  match p, q with
  | [], [] => true
  | v :: p, w :: q => (v =? w) && same p q
  | _, _ => false
  end.

(* The set-up, the unit in integers and the unit in words all agree with the C++. *)
Definition agrees (c : Case) : bool :=
  let r := set_up (format c) (major c) (ray c) in
  let p := quantise_box (format c) (box c) in
  same (operand_words r p) (words c) && eqb (test (format c) r p) (answer c) &&
  eqb (test_words (format c) r p) (answer c).
