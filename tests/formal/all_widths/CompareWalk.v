(* Compares the walk with what the C++ does. emit_walks.cpp writes the cases. *)
From Coq Require Import ZArith List Bool.
From HitpipeMajor Require Import Walk.
Import ListNotations.
Open Scope Z_scope.

Record WalkCase := {
  walked : tree;
  most_places : nat;  (* of the stack *)
  shift : Z;          (* a distance of boxes is 2^shift units of T *)
  limit : hit;
  in_turn : list (list hit);  (* the leaves that were tested *)
  least : hit;
  begins_again : bool
}.

Definition scaled_by (shift t : Z) : Z := Z.shiftr t shift.

Fixpoint walk (c : WalkCase) (steps : nat) (s : state) : list (list hit) * option hit :=
  match steps, s with
  | _, Done best => ([], Some best)
  | O, _ => ([], None)
  | S steps, _ =>
      let (leaves, best) := walk c steps (step (walked c) (most_places c) (fun _ => true) (scaled_by (shift c)) s) in
      (tests_now s ++ leaves, best)
  end.

Definition same_hit (a b : hit) : bool := (fst a =? fst b) && (snd a =? snd b).
Fixpoint same_list {A} (same : A -> A -> bool) (p q : list A) : bool :=
  match p, q with
  | [], [] => true
  | a :: p, b :: q => same a b && same_list same p q
  | _, _ => false
  end.

Definition walk_agrees (c : WalkCase) : bool :=
  match walk c (Z.to_nat 100000) (At [] [] (walked c) [] (limit c)) with
  | (leaves, Some best) => same_list (same_list same_hit) leaves (in_turn c) && same_hit best (least c)
  | (_, None) => false
  end.
