(* Compares the definition with what the C++ computes. emit_cases.cpp writes the cases. *)
From Coq Require Import ZArith QArith List Bool.
From HitpipeMajor Require Import IntMajor IntegerWorld Datapath.
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
Definition all_agree f (r : MajorRay) (p : MajorPlanes) (words : list Z) (answer : bool) : bool :=
  same (operand_words r p) words && eqb (test f r p) answer && eqb (test_words f r p) answer.

Definition agrees (c : Case) : bool :=
  let f := format c in
  all_agree f (set_up f (major c) (ray c)) (quantise_box f (box c)) (words c) (answer c).

(* The same in the integer world. *)
Record IntegerCase := {
  integer_format : Format;
  integer_major : Axis;
  integer_ray : IntegerRay;
  integer_box : IntegerBox;
  integer_words : list Z;
  integer_answer : bool
}.

Definition integer_agrees (c : IntegerCase) : bool :=
  let f := integer_format c in
  all_agree f (integer_set_up f (integer_major c) (integer_ray c)) (integer_planes (integer_box c))
    (integer_words c) (integer_answer c).
