(* The unit int_major as integer arithmetic, its ray set-up and its boxes as rational arithmetic.
   A float is a rational number, so rational inputs cover all floats. Names are as in the C++. *)
From Coq Require Import ZArith QArith Qabs Qround Lia Bool.
From HitpipeMajor Require Import Numbers.
Open Scope Z_scope.

(* hls/box/major_format.hpp: the format n+g/pfFsS. *)
Record Format := {
  coord : Z;     (* n *)
  finer : Z;     (* g *)
  mantissa : Z;  (* p *)
  fraction : Z;  (* F *)
  slope : Z      (* S; 0 in the float world *)
}.

Definition integer_world f : bool := 0 <? slope f.

Lemma in_float_world f : slope f = 0 -> integer_world f = false.
Proof. unfold integer_world. intros ->. reflexivity. Qed.
Lemma in_integer_world f : 0 < slope f -> integer_world f = true.
Proof. apply Z.ltb_lt. Qed.

Definition point f := coord f + finer f.
Definition trimmed f := mantissa f - 1 + finer f - fraction f.
Definition distance f := coord f + fraction f + 1.
Definition largest_point f := 2 ^ (coord f - 2) - 1.
Definition largest_length f := 2 ^ (coord f + fraction f - 1) - 1.
Definition largest_exponent f := point f - 1.
Definition largest_mantissa f := 2 ^ mantissa f - 1.

(* There is no upper bound. *)
Record valid (f : Format) : Prop := {
  valid_coord : 2 <= coord f;
  valid_finer : 0 <= finer f;
  valid_mantissa : 1 <= mantissa f;
  valid_trimmed : 0 <= trimmed f;
  valid_distance : 1 <= coord f + fraction f
}.

(* MajorBits::proved() asks for more. *)
Lemma program_formats_are_valid f :
  4 <= coord f -> 0 <= finer f -> 3 <= mantissa f -> -2 <= fraction f -> 0 <= trimmed f -> valid f.
Proof. intros. constructor; lia. Qed.

Inductive Axis := x | y | z.

Record Ray := {
  origin : Axis -> Q;
  direction : Axis -> Q;
  length : option Q  (* None: a ray without an end *)
}.

Record Box := { lo : Axis -> Q; hi : Axis -> Q }.

(* What the units ask of their inputs. *)
Definition in_cube (c : Q) : Prop := (-(1) <= c <= 1)%Q.

Record acceptable_ray (ray : Ray) : Prop := {
  origin_in_cube : forall k, in_cube (origin ray k);
  length_positive : forall l, length ray = Some l -> (0 <= l)%Q
}.

Definition acceptable_box (box : Box) : Prop := forall k, in_cube (lo box k) /\ in_cube (hi box k).

(* The exact answer: the ray and the closed box have a point in common. *)
Definition meets (ray : Ray) (box : Box) : Prop :=
  exists t : Q,
    (0 <= t)%Q /\ (forall l, length ray = Some l -> (t <= l)%Q) /\
    forall k, (lo box k <= origin ray k + t * direction ray k <= hi box k)%Q.

(* The set-up may choose any largest component. *)
Definition is_major (major : Axis) (ray : Ray) : Prop :=
  forall k, (Qabs (direction ray k) <= Qabs (direction ray major))%Q.

(* ---- Ray set-up: rays/world/int_major_ray.cpp, grid.hpp ---- *)

Definition negative (c : Q) : bool := negb (Qle_bool 0 c).

(* c on the grid of the origin. *)
Definition on_fine_grid f (c : Q) : Q := (inject_Z (largest_point f) * pow2 (finer f) * c)%Q.

(* The nearest point of the fine grid, then mirrored. In the mirrored world a tie goes down. *)
Definition origin_word f (back : bool) (c : Q) : Z :=
  if back then - Qfloor (on_fine_grid f c + (1 # 2)) - 1 else Qceiling (on_fine_grid f c - (1 # 2)).

Record MajorQuotient := { mantissa_low : Z; mantissa_high : Z; exponent : Z }.

(* 2^(p-1) |D_M| / |D_k| in units of 2^e. *)
Definition scaled_quotient f (major other : Q) (e : Z) : Q :=
  (pow2 (mantissa f - 1) * (major / other) * pow2 (- e))%Q.

Definition fits f major other e : bool :=
  Qceiling (scaled_quotient f major other e) <=? largest_mantissa f.

(* The first of `count` exponents from e on for which the upper mantissa fits. *)
Fixpoint smallest_exponent f major other (count : nat) (e : Z) : option Z :=
  match count with
  | O => None
  | S fewer => if fits f major other e then Some e else smallest_exponent f major other fewer (e + 1)
  end.

(* `cap` is the largest exponent: n + g - 1, except where a smaller one is shown to miss. *)
Definition too_large f (cap : Z) : MajorQuotient :=
  {| mantissa_low := largest_mantissa f; mantissa_high := largest_mantissa f; exponent := cap |}.

Definition quotient f (cap : Z) (major other : Q) : MajorQuotient :=
  if Qeq_bool other 0 then too_large f cap
  else match smallest_exponent f major other (Z.to_nat (cap + 1)) 0 with
       | Some e => {| mantissa_low := Qfloor (scaled_quotient f major other e);
                      mantissa_high := Qceiling (scaled_quotient f major other e);
                      exponent := e |}
       | None => too_large f cap
       end.

Definition length_word f (major : Q) (l : option Q) : Z :=
  match l with
  | Some l => Z.min (Qfloor (l * major * inject_Z (largest_point f) * pow2 (fraction f))) (largest_length f)
  | None => largest_length f
  end.

(* hls/box/int_major_operands.hpp: what the unit knows of a ray, and its length. *)
Record MajorRay := {
  major_y : bool; major_z : bool;
  back_m : bool; back_a : bool; back_b : bool;
  origin_m : Z; origin_a : Z; origin_b : Z;
  floor_a : Z; ceil_a : Z;
  floor_b : Z; ceil_b : Z;
  exp_a : Z; exp_b : Z;
  len : Z
}.

(* Which axes the ray axes a and b are: M and x have changed places. *)
Definition axis_a (major : Axis) : Axis := match major with y => x | _ => y end.
Definition axis_b (major : Axis) : Axis := match major with z => x | _ => z end.

Definition set_up_to (cap : Z) f (major : Axis) (ray : Ray) : MajorRay :=
  let back k := negative (direction ray k) in
  let word k := origin_word f (back k) (origin ray k) in
  let largest := Qabs (direction ray major) in
  let q k := quotient f cap largest (Qabs (direction ray k)) in
  let a := axis_a major in
  let b := axis_b major in
  {| major_y := match major with y => true | _ => false end;
     major_z := match major with z => true | _ => false end;
     back_m := back major; back_a := back a; back_b := back b;
     origin_m := word major; origin_a := word a; origin_b := word b;
     floor_a := mantissa_low (q a); ceil_a := mantissa_high (q a);
     floor_b := mantissa_low (q b); ceil_b := mantissa_high (q b);
     exp_a := exponent (q a); exp_b := exponent (q b);
     len := length_word f largest (length ray) |}.

Definition set_up f := set_up_to (largest_exponent f) f.

(* ---- Boxes: rays/world/int_box.cpp ---- *)

Record MajorPlanes := { xmin : Z; xmax : Z; ymin : Z; ymax : Z; zmin : Z; zmax : Z }.

(* A plane moves outward by half a unit of the fine grid and is rounded outward to the coarse one. *)
Definition lower f (c : Q) : Z := Qfloor (inject_Z (largest_point f) * c - pow2 (- (finer f + 1))).
Definition upper f (c : Q) : Z := Qceiling (inject_Z (largest_point f) * c + pow2 (- (finer f + 1))).

Definition quantise_box f (box : Box) : MajorPlanes :=
  {| xmin := lower f (lo box x); xmax := upper f (hi box x);
     ymin := lower f (lo box y); ymax := upper f (hi box y);
     zmin := lower f (lo box z); zmax := upper f (hi box z) |}.

(* ---- The unit: hls/pipelines/major_parts.hpp, int_major.hpp ---- *)

Record NearFar X := { near : X; far : X }.
Arguments near {X}. Arguments far {X}. Arguments Build_NearFar {X}.

Record RayAxes X := { m : X; a : X; b : X }.
Arguments m {X}. Arguments a {X}. Arguments b {X}. Arguments Build_RayAxes {X}.

Definition to_ray_axes {X} (ray : MajorRay) (x y z : X) : RayAxes X :=
  {| m := if major_z ray then z else if major_y ray then y else x;
     a := if major_y ray then x else y;
     b := if major_z ray then x else z |}.

Definition in_ray_order {X} (back : bool) (low high : X) : NearFar X :=
  {| near := if back then high else low; far := if back then low else high |}.

(* x -> -x - 1 on the fine grid. *)
Definition mirrored (back : bool) (c : Z) : Z := if back then - c - 1 else c.

(* In the integer world the origin is negated, and the far difference has a carry of 1. *)
Definition difference f (carry plane origin : Z) (back : bool) : Z :=
  let mirrored_plane := mirrored back (plane * 2 ^ finer f) in
  if integer_world f then mirrored_plane + origin + carry else mirrored_plane - origin.

Definition major_distance f (d : Z) : Z := Qfloor (inject_Z d * pow2 (fraction f) * pow2 (- finer f)).

Definition saturating_shift f (d e : Z) : Z :=
  Z.max (- 2 ^ (point f - 1)) (Z.min (2 ^ (point f - 1) - 1) (d * 2 ^ e)).

Definition scaled_distance f (d mantissa exponent : Z) : Z :=
  saturating_shift f d exponent * mantissa / 2 ^ trimmed f.

Definition scaled_slab f (d : NearFar Z) (floor ceil exponent : Z) : NearFar Z :=
  {| near := scaled_distance f (near d) (if near d <? 0 then ceil else floor) exponent;
     far := scaled_distance f (far d) (if far d <? 0 then floor else ceil) exponent |}.

(* `carry` is 1, except where 0 is shown to miss. *)
Definition plane_distances_with (carry : Z) f (ray : MajorRay) (planes : MajorPlanes) : RayAxes (NearFar Z) :=
  let low := to_ray_axes ray (xmin planes) (ymin planes) (zmin planes) in
  let high := to_ray_axes ray (xmax planes) (ymax planes) (zmax planes) in
  let differences back lower upper origin :=
    let plane := in_ray_order back lower upper in
    {| near := difference f 0 (near plane) origin back; far := difference f carry (far plane) origin back |} in
  let dm := differences (back_m ray) (m low) (m high) (origin_m ray) in
  let da := differences (back_a ray) (a low) (a high) (origin_a ray) in
  let db := differences (back_b ray) (b low) (b high) (origin_b ray) in
  {| m := {| near := major_distance f (near dm); far := major_distance f (far dm) |};
     a := scaled_slab f da (floor_a ray) (ceil_a ray) (exp_a ray);
     b := scaled_slab f db (floor_b ray) (ceil_b ray) (exp_b ray) |}.

Definition plane_distances := plane_distances_with 1.

Definition test_with (carry : Z) f (ray : MajorRay) (planes : MajorPlanes) : bool :=
  let t := plane_distances_with carry f ray planes in
  let near := Z.max (Z.max (near (m t)) (near (a t))) (near (b t)) in
  let far := Z.min (Z.min (far (m t)) (far (a t))) (far (b t)) in
  (0 <=? far) && (near <=? far) && (near <=? len ray).

Definition test := test_with 1.

(* The answer of the unit to a ray and a box. *)
Definition hit f (major : Axis) (ray : Ray) (box : Box) : bool :=
  test f (set_up f major ray) (quantise_box f box).
