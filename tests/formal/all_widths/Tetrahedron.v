(* A tetrahedron and a ray: the ray crosses its faces, from the ray's origin on, an odd number of times if the
   origin is inside, and an even number of times if it is not and on no face. The rule is that of Crossing.v.

   Few signs decide this: on which side the line passes each edge, and the sign of each face's volume. What is
   known of them is proved first. The rest is a computation over all signs. CrossingOrigin.v makes a closed mesh of
   tetrahedra with a common apex. *)
From Coq Require Import ZArith Lia Bool.
From HitpipeMajor Require Import Crossing FaceAhead.
Open Scope Z_scope.

(* ---- The origin inside ---- *)

(* What holds for -1, 0 and 1 holds for every sign; so a statement on signs is a computation. *)
Definition for_signs (f : Z -> bool) : bool := f (-1) && f 0 && f 1.
Definition is_sign (n : Z) : Prop := Z.sgn n = n.

Lemma for_all_signs f : for_signs f = true -> forall n, is_sign n -> f n = true.
Proof.
  unfold for_signs, is_sign. rewrite !andb_true_iff. intros [[Minus Zero] Plus] n <-.
  destruct (Z.sgn_spec n) as [[_ ->] | [[_ ->] | [_ ->]]]; assumption.
Qed.

Definition differ (m n : Z) : bool := negb (m =? n).
Definition cyclic (a b c : Z) : bool := differ a 0 && (b =? a) && (c =? a).

(* Four places j, k, l, m: each pair has a side, 0 only at one place. If no triangle is crossed, one place is the
   first: it has no other on its negative side. *)
Definition same_place (jk jl kl jm km : Z) : bool := implb (jk =? 0) ((jl =? kl) && (jm =? km)).
Definition is_first (jk jl jm : Z) : bool := (0 <=? jk) && (0 <=? jl) && (0 <=? jm).
Definition some_is_first (jk jl jm kl lm mk : Z) : bool :=
  implb
    (same_place jk jl kl jm (- mk) && same_place jl jk (- kl) jm lm && same_place jm jk mk jl (- lm) &&
     same_place kl (- jk) (- jl) (- mk) lm && same_place lm (- jl) (- jm) (- kl) mk &&
     same_place mk (- jm) (- jk) (- lm) kl &&
     negb (cyclic kl lm mk) && negb (cyclic jk kl (- jl)) && negb (cyclic jl lm (- jm)) &&
     negb (cyclic jm mk (- jk)))
    (is_first jk jl jm || is_first (- jk) kl (- mk) || is_first (- jl) lm (- kl) || is_first (- jm) mk (- lm)).

Ltac for_sign n :=
  match goal with H : for_signs _ = true |- _ => apply (fun Is => for_all_signs _ Is n) in H; [| assumption] end;
  cbv beta in *.

Lemma some_place_is_first jk jl jm kl lm mk :
  is_sign jk -> is_sign jl -> is_sign jm -> is_sign kl -> is_sign lm -> is_sign mk ->
  some_is_first jk jl jm kl lm mk = true.
Proof.
  intros.
  assert (for_signs (fun a => for_signs (fun b => for_signs (fun c => for_signs (fun d => for_signs (fun e =>
            for_signs (fun f => some_is_first a b c d e f)))))) = true) as All by (vm_compute; reflexivity).
  for_sign jk. for_sign jl. for_sign jm. for_sign kl. for_sign lm. for_sign mk. exact All.
Qed.

Lemma side_is_sign p q : is_sign (side p q).
Proof. apply Z.sgn_sgn. Qed.

Lemma same_place_holds j k l m : same_place (side j k) (side j l) (side k l) (side j m) (side k m) = true.
Proof.
  unfold same_place. destruct (Z.eqb_spec (side j k) 0) as [Same |]; [| reflexivity].
  apply side_is_zero in Same. subst k. rewrite !Z.eqb_refl. reflexivity.
Qed.

(* Round an origin within, no place is the first, unless all four are in a line. *)
Lemma first_is_in_line j k l m a b c d :
  0 < a -> 0 < b -> 0 < c -> 0 < d ->
  a * A j + b * A k + c * A l + d * A m = 0 -> a * B j + b * B k + c * B l + d * B m = 0 ->
  is_first (side j k) (side j l) (side j m) = true -> edge k l = 0 /\ edge l m = 0 /\ edge m k = 0.
Proof.
  intros Pa Pb Pc Pd OfA OfB First. unfold is_first in First.
  rewrite !andb_true_iff, !Z.leb_le in First. destruct First as [[Jk Jl] Jm].
  assert (forall q, 0 <= side j q -> 0 <= edge j q /\ (edge j q = 0 -> B q <= B j)) as Signs.
  { intros q. unfold side, first_not_zero. rewrite Z.sgn_nonneg.
    destruct (Z.eqb_spec (edge j q) 0), (Z.eqb_spec (B j - B q) 0); lia. }
  destruct (Signs k Jk) as [Ek Hk], (Signs l Jl) as [El Hl], (Signs m Jm) as [Em Hm].
  assert (b * edge j k + c * edge j l + d * edge j m = 0) as Sum.
  { unfold edge. transitivity (A j * (a * B j + b * B k + c * B l + d * B m) -
                               B j * (a * A j + b * A k + c * A l + d * A m)); [ring | rewrite OfA, OfB; ring]. }
  assert (edge j k = 0 /\ edge j l = 0 /\ edge j m = 0) as [Zk [Zl Zm]] by (clear - Pb Pc Pd Ek El Em Sum; nia).
  specialize (Hk Zk). specialize (Hl Zl). specialize (Hm Zm). clear - Pb Pc Pd OfB Zk Zl Zm Hk Hl Hm.
  assert (forall p q, edge j p = 0 -> edge j q = 0 -> A j * edge p q = 0 /\ B j * edge p q = 0) as InLine.
  { intros p q P Q. unfold edge in *. split.
    - transitivity (A p * (A j * B q - A q * B j) - A q * (A j * B p - A p * B j)); [ring | rewrite P, Q; ring].
    - transitivity (B p * (A j * B q - A q * B j) - B q * (A j * B p - A p * B j)); [ring | rewrite P, Q; ring]. }
  destruct (InLine k l Zk Zl), (InLine l m Zl Zm), (InLine m k Zm Zk).
  destruct (Z.eq_dec (A j) 0); [| repeat split; nia].
  destruct (Z.eq_dec (B j) 0) as [Zero |]; [| repeat split; nia].
  assert (B k = 0 /\ B l = 0 /\ B m = 0) as [Bk [Bl Bm]] by (rewrite Zero in *; nia).
  unfold edge. rewrite Bk, Bl, Bm. lia.
Qed.

(* The origin is strictly inside the tetrahedron of p, q, r and the apex z: volumes of one sign, each face as the
   boundary runs. *)
Definition inside_signs (v v1 v2 v3 : Z) : bool := differ v 0 && (v1 =? - v) && (v2 =? - v) && (v3 =? - v).
Definition inside (z p q r : Point) : bool :=
  inside_signs (Z.sgn (volume p q r)) (Z.sgn (volume z p q)) (Z.sgn (volume z q r)) (Z.sgn (volume z r p)).

Lemma not_cyclic a b c : (if (b =? a) && (c =? a) then a else 0) = 0 -> cyclic a b c = false.
Proof.
  unfold cyclic, differ. destruct (Z.eqb_spec a 0), (b =? a), (c =? a); cbn; congruence.
Qed.

(* A line from inside crosses a face: else one place would be the first. *)
Lemma inside_is_crossed z p q r :
  inside z p q r = true ->
  negb (differ (sign_of_face p q r) 0) && negb (differ (sign_of_face z p q) 0) &&
  negb (differ (sign_of_face z q r) 0) && negb (differ (sign_of_face z r p) 0) = false.
Proof.
  intro Inside. apply not_true_iff_false. intro None.
  unfold inside, inside_signs, differ in *. rewrite !andb_true_iff, ?negb_true_iff, ?negb_false_iff in *.
  rewrite !Z.eqb_eq, Z.eqb_neq in *. destruct Inside as [[[V V1] V2] V3], None as [[[Npqr Nzpq] Nzqr] Nzrp].
  pose proof (four_points z p q r (fun n => A (place n)) ltac:(auto)) as OfA.
  pose proof (four_points z p q r (fun n => B (place n)) ltac:(auto)) as OfB. cbv beta in OfA, OfB.
  assert (volume z p r = - volume z r p) as Turned by (unfold volume, edge; ring). rewrite Turned in OfA, OfB.
  assert (exists k, 0 < k * volume p q r /\ 0 < k * - volume z q r /\ 0 < k * - volume z r p /\
                    0 < k * - volume z p q) as [k [Wz [Wp [Wq Wr]]]]
    by (clear - V V1 V2 V3; destruct (Z_lt_ge_dec 0 (volume p q r)); [exists 1 | exists (-1)]; lia).
  unfold sign_of_face in *. rewrite sign_by_sides in Npqr, Nzpq, Nzqr, Nzrp.
  set (P := place p) in *. set (Q := place q) in *. set (R := place r) in *. set (Z := place z) in *.
  pose proof (some_place_is_first (side Z P) (side Z Q) (side Z R) (side P Q) (side Q R) (side R P)
    (side_is_sign _ _) (side_is_sign _ _) (side_is_sign _ _) (side_is_sign _ _) (side_is_sign _ _)
    (side_is_sign _ _)) as First.
  pose proof (same_place_holds Z P Q R) as S1. pose proof (same_place_holds Z Q P R) as S2.
  pose proof (same_place_holds Z R P Q) as S3. pose proof (same_place_holds P Q Z R) as S4.
  pose proof (same_place_holds Q R Z P) as S5. pose proof (same_place_holds R P Z Q) as S6.
  rewrite ?(side_turned Z P), ?(side_turned Z Q), ?(side_turned Z R), ?(side_turned P Q), ?(side_turned Q R),
    ?(side_turned R P) in *.
  unfold some_is_first in First. rewrite S1, S2, S3, S4, S5, S6 in First.
  apply not_cyclic in Npqr, Nzpq, Nzqr, Nzrp. rewrite Npqr, Nzpq, Nzqr, Nzrp in First.
  cbn [negb andb implb] in First.
  rewrite <- !side_turned in First. rewrite !orb_true_iff in First. clear - First OfA OfB Wz Wp Wq Wr.
  assert (forall n, n = 0 -> k * n = 0) as Scale by (intros n ->; ring). apply Scale in OfA, OfB. clear Scale.
  destruct First as [[[First | First] | First] | First].
  - apply (first_is_in_line Z P Q R _ _ _ _ Wz Wp Wq Wr) in First; [| clear - OfA; lia | clear - OfB; lia].
    destruct First as [E1 [E2 E3]]. unfold volume in Wz. fold P Q R Z in Wz. rewrite E1, E2, E3 in Wz. lia.
  - apply (first_is_in_line P Z Q R _ _ _ _ Wp Wz Wq Wr) in First; [| clear - OfA; lia | clear - OfB; lia].
    destruct First as [E1 [E2 E3]]. unfold volume in Wp. fold P Q R Z in Wp. rewrite E1, E2, E3 in Wp. lia.
  - apply (first_is_in_line Q Z R P _ _ _ _ Wq Wz Wr Wp) in First; [| clear - OfA; lia | clear - OfB; lia].
    destruct First as [E1 [E2 E3]]. unfold volume in Wq. fold P Q R Z in Wq. rewrite E1, E2, E3 in Wq. lia.
  - apply (first_is_in_line R Z P Q _ _ _ _ Wr Wz Wp Wq) in First; [| clear - OfA; lia | clear - OfB; lia].
    destruct First as [E1 [E2 E3]]. unfold volume in Wr. fold P Q R Z in Wr. rewrite E1, E2, E3 in Wr. lia.
Qed.

Lemma inside_from_next z p q r : inside z q r p = inside z p q r.
Proof.
  unfold inside, inside_signs. rewrite (volume_from_next p q r).
  destruct (differ _ _), (Z.sgn (volume z p q) =? _), (Z.sgn (volume z q r) =? _), (Z.sgn (volume z r p) =? _);
    reflexivity.
Qed.

(* ---- Signs of the faces ---- *)

(* As `sign_ahead`, by the face's sign x and the sign v of its volume. *)
Definition face_ahead (v x : Z) : Z := if v =? x then x else 0.

(* What is known of the signs with which faces are crossed, x, and of those of their volumes, v. *)
Definition signs_are_parity (x1 x2 x3 v v1 v2 v3 : Z) : bool :=
  let x := x1 + x2 + x3 in
  let inside := inside_signs v v1 v2 v3 in
  let pair a b u w := implb (differ a 0 && (a =? b) && (u =? - w)) inside in
  implb
    (((x =? 0) || (x =? 1) || (x =? -1)) &&
     negb (differ x 0 && differ x1 0 && differ x2 0 && differ x3 0) &&
     implb (differ x 0) (differ v 0) && implb (differ x1 0) (differ v1 0) && implb (differ x2 0) (differ v2 0) &&
     implb (differ x3 0) (differ v3 0) &&
     implb inside (differ x 0 || differ x1 0 || differ x2 0 || differ x3 0) &&
     pair x x1 v v1 && pair x x2 v v2 && pair x x3 v v3 &&
     pair x1 (- x2) v1 (- v2) && pair x2 (- x3) v2 (- v3) && pair x3 (- x1) v3 (- v1))
    (eqb (Z.odd (face_ahead v x - face_ahead v1 x1 - face_ahead v2 x2 - face_ahead v3 x3)) inside).

Lemma signs_give_parity x1 x2 x3 v v1 v2 v3 :
  is_sign x1 -> is_sign x2 -> is_sign x3 -> is_sign v -> is_sign v1 -> is_sign v2 -> is_sign v3 ->
  signs_are_parity x1 x2 x3 v v1 v2 v3 = true.
Proof.
  intros.
  assert (for_signs (fun a => for_signs (fun b => for_signs (fun c => for_signs (fun d => for_signs (fun e =>
            for_signs (fun f => for_signs (fun g => signs_are_parity a b c d e f g))))))) = true) as All
    by (vm_compute; reflexivity).
  for_sign x1. for_sign x2. for_sign x3. for_sign v. for_sign v1. for_sign v2. for_sign v3. exact All.
Qed.

(* Where no face holds the origin, a crossed face is ahead if its volume has its sign. *)
Lemma sign_ahead_is p q r :
  ~ holds_origin p q r -> sign_ahead p q r = face_ahead (Z.sgn (volume p q r)) (sign_of_face p q r) /\
  (sign_of_face p q r <> 0 -> volume p q r <> 0).
Proof.
  intro Apart. split; [| intros Crossed Flat; apply Apart, crossed_at_origin; assumption].
  unfold sign_ahead, ahead, face_ahead. destruct (Z.eq_dec (sign_of_face p q r) 0) as [Zero | Crossed].
  - rewrite Zero. destruct (_ <=? _), (_ =? _); reflexivity.
  - assert (volume p q r <> 0) by (intro Flat; apply Apart, crossed_at_origin; assumption).
    destruct (crossed_face p q r _ eq_refl Crossed) as [Det _]. rewrite <- Det.
    set (d := det _ _ _) in *. set (v := volume p q r) in *. assert (d <> 0) by lia. clearbody d v.
    destruct (Z.leb_spec 0 (v * d)), (Z.eqb_spec (Z.sgn v) (Z.sgn d)); nia.
Qed.

Lemma sign_is_sign p q r : is_sign (sign_of_face p q r).
Proof.
  unfold sign_of_face, is_sign. destruct (crossing_sign_is (place p) (place q) (place r)) as [-> | [-> | [-> _]]];
    reflexivity.
Qed.

(* The sum over the faces, each as the tetrahedron's boundary runs. *)
Lemma faces_sum z p q r :
  sign_of_face p q r = sign_of_face z p q + sign_of_face z q r + sign_of_face z r p.
Proof.
  unfold sign_of_face. rewrite <- !triangle_edges.
  rewrite (through_turned (place z) (place p)), (through_turned (place z) (place q)),
    (through_turned (place z) (place r)). ring.
Qed.

(* The line never crosses all four faces. *)
Lemma never_four z p q r :
  differ (sign_of_face p q r) 0 && differ (sign_of_face z p q) 0 && differ (sign_of_face z q r) 0 &&
  differ (sign_of_face z r p) 0 = false.
Proof.
  unfold sign_of_face, differ. rewrite !sign_by_sides.
  rewrite (side_turned (place z) (place p)), (side_turned (place z) (place q)), (side_turned (place z) (place r)).
  set (a := side (place p) (place q)). set (b := side (place q) (place r)). set (c := side (place r) (place p)).
  set (d := side (place z) (place p)). set (e := side (place z) (place q)). set (f := side (place z) (place r)).
  clearbody a b c d e f.
  destruct (Z.eqb_spec b a), (Z.eqb_spec c a), (Z.eqb_spec a d), (Z.eqb_spec (- e) d), (Z.eqb_spec b e),
    (Z.eqb_spec (- f) e), (Z.eqb_spec c f), (Z.eqb_spec (- d) f); cbn [andb negb]; rewrite ?andb_false_r;
    try reflexivity; lia.
Qed.

(* Two crossed faces with one sign, whose volumes have two: the origin is between them. *)
Lemma pair_of_faces a b c d :
  ~ holds_origin a c d -> ~ holds_origin b c d ->
  sign_of_face a b c <> 0 -> sign_of_face a b c = sign_of_face a b d ->
  Z.sgn (volume a b c) = - Z.sgn (volume a b d) -> volume a b c <> 0 ->
  Z.sgn (volume b c d) = Z.sgn (volume a b d) /\ Z.sgn (volume a c d) = - Z.sgn (volume a b d).
Proof.
  intros Acd Bcd Crossed Same Opposite NotZero.
  destruct (between_faces a b c d (sign_of_face a b c)) as [First Second]; auto; [clear - Opposite NotZero; nia |].
  clear - First Second. nia.
Qed.

(* ---- The tetrahedron ---- *)

(* The origin is on no face. *)
Definition off_faces (z p q r : Point) : Prop :=
  ~ holds_origin p q r /\ ~ holds_origin z p q /\ ~ holds_origin z q r /\ ~ holds_origin z r p.

Lemma off_faces_from_next z p q r : off_faces z p q r -> off_faces z q r p.
Proof.
  intros [Base [First [Second Third]]]. split; [| tauto]. intro On. apply Base, holds_origin_from_next, On.
Qed.

(* Two faces, crossed with one sign as the boundary runs, whose volumes have two signs. *)
Definition pair (z p q r : Point) (a b u w : Z) : bool :=
  implb (differ a 0 && (a =? b) && (Z.sgn u =? - Z.sgn w)) (inside z p q r).

Lemma pair_with_base z p q r :
  off_faces z p q r ->
  pair z p q r (sign_of_face p q r) (sign_of_face z p q) (volume p q r) (volume z p q) = true.
Proof.
  intros [Base [_ [Second Third]]]. unfold pair, differ. apply implb_true_iff.
  rewrite !andb_true_iff, negb_true_iff, Z.eqb_neq, !Z.eqb_eq. intros [[Crossed Same] Opposite].
  destruct (sign_ahead_is p q r Base) as [_ NotFlat]. specialize (NotFlat Crossed).
  destruct (pair_of_faces p q r z) as [IsSecond IsThird]; auto.
  - intro On. apply Third, holds_origin_from_next, holds_origin_turned, On.
  - intro On. apply Second, holds_origin_from_next, On.
  - rewrite Same. symmetry. apply sign_from_next_corner.
  - rewrite (volume_from_next z p q). exact Opposite.
  - rewrite (volume_from_next z p q) in IsSecond, IsThird. rewrite (volume_from_next z q r) in IsSecond.
    assert (volume p r z = - volume z r p) as Turned by (unfold volume, edge; ring). rewrite Turned in IsThird.
    unfold inside, inside_signs, differ. lia.
Qed.

Lemma pair_of_sides z p q r :
  off_faces z p q r ->
  pair z p q r (sign_of_face z p q) (- sign_of_face z q r) (volume z p q) (- volume z q r) = true.
Proof.
  intros [Base [First [Second Third]]]. unfold pair, differ. apply implb_true_iff.
  rewrite !andb_true_iff, negb_true_iff, Z.eqb_neq, !Z.eqb_eq. intros [[Crossed Same] Opposite].
  assert (sign_of_face z q p = - sign_of_face z p q) as Face
    by (unfold sign_of_face;
        rewrite (sign_from_next_corner (place p) (place z) (place q)); apply sign_from_other_side).
  assert (volume z q p = - volume z p q) as Volume by (unfold volume, edge; ring).
  destruct (sign_ahead_is z q r Second) as [_ NotFlat]. specialize (NotFlat ltac:(lia)).
  destruct (pair_of_faces z q r p) as [IsBase IsThird]; try lia.
  - exact Third.
  - intro On. apply Base, holds_origin_from_next, On.
  - assert (volume q r p = volume p q r) as Base' by apply volume_from_next.
    unfold inside, inside_signs, differ. lia.
Qed.

(* The headline. *)
Theorem faces_ahead_are_odd_inside z p q r :
  off_faces z p q r ->
  Z.odd (sign_ahead p q r - sign_ahead z p q - sign_ahead z q r - sign_ahead z r p) = inside z p q r.
Proof.
  intro Off. pose proof (off_faces_from_next _ _ _ _ Off) as Off1.
  pose proof (off_faces_from_next _ _ _ _ Off1) as Off2.
  pose proof (pair_with_base _ _ _ _ Off) as B1. pose proof (pair_with_base _ _ _ _ Off1) as B2.
  pose proof (pair_with_base _ _ _ _ Off2) as B3. pose proof (pair_of_sides _ _ _ _ Off) as S1.
  pose proof (pair_of_sides _ _ _ _ Off1) as S2. pose proof (pair_of_sides _ _ _ _ Off2) as S3.
  pose proof (inside_is_crossed z p q r) as Inside. pose proof (never_four z p q r) as Four.
  pose proof (signs_give_parity (sign_of_face z p q) (sign_of_face z q r) (sign_of_face z r p)
    (Z.sgn (volume p q r)) (Z.sgn (volume z p q)) (Z.sgn (volume z q r)) (Z.sgn (volume z r p))
    (sign_is_sign _ _ _) (sign_is_sign _ _ _) (sign_is_sign _ _ _) (Z.sgn_sgn _) (Z.sgn_sgn _) (Z.sgn_sgn _)
    (Z.sgn_sgn _)) as Parity.
  pose proof (sign_is_sign p q r) as Sign.
  destruct Off as [Base [First [Second Third]]].
  destruct (sign_ahead_is p q r Base) as [-> N], (sign_ahead_is z p q First) as [-> N1],
    (sign_ahead_is z q r Second) as [-> N2], (sign_ahead_is z r p Third) as [-> N3].
  assert (sign_of_face q r p = sign_of_face p q r) as F1 by apply sign_from_next_corner.
  assert (sign_of_face r p q = sign_of_face p q r) as F2
    by (rewrite <- F1; apply sign_from_next_corner).
  unfold pair in *. rewrite ?F1, ?F2, ?(inside_from_next z q r p), ?(inside_from_next z p q r),
    ?(volume_from_next q r p), ?(volume_from_next p q r), ?Z.sgn_opp in *.
  unfold signs_are_parity in Parity. rewrite <- faces_sum in Parity.
  change (inside_signs _ _ _ _) with (inside z p q r) in Parity.
  set (x := sign_of_face p q r) in *. cbv zeta in Parity. rewrite Four, B1, B2, B3, S1, S2, S3 in Parity.
  assert (forall a v, (a <> 0 -> v <> 0) -> implb (differ a 0) (differ (Z.sgn v) 0) = true) as NotFlat
    by (intros a v Flat; unfold differ; lia).
  rewrite (NotFlat _ _ N), (NotFlat _ _ N1), (NotFlat _ _ N2), (NotFlat _ _ N3) in Parity.
  assert (((x =? 0) || (x =? 1) || (x =? -1)) = true) as IsSign
    by (clear - Sign; unfold is_sign in Sign; destruct (Z.sgn_spec x) as [[_ E] | [[_ E] | [_ E]]]; lia).
  rewrite IsSign in Parity. apply eqb_prop.
  destruct (inside z p q r).
  - specialize (Inside eq_refl). rewrite <- !negb_orb in Inside. apply negb_false_iff in Inside.
    rewrite Inside in Parity. exact Parity.
  - exact Parity.
Qed.
