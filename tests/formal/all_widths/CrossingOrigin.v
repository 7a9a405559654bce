(* Inside or outside: from its origin on, a ray crosses a closed mesh as oddly as any other ray from that origin.

   If the origin is on no triangle of the mesh, the number of triangles that a ray crosses at a distance T >= 0 is
   odd for all rays from it, or even for all. So one ray in any direction says whether the origin is inside.

   The proof makes a tetrahedron of each triangle and one apex. Every other face of these belongs to an edge of the
   mesh, so each occurs an even number of times. What remains is in how many of the tetrahedra the origin is
   (Tetrahedron.v), and no direction changes that. The apex is so chosen that the origin is on no face. *)
From Coq Require Import ZArith QArith Lia Lqa Bool List.
From HitpipeMajor Require Import Numbers IntMajor NeverMisses IntegerWorld IntegerTriangle Triangle TriangleHit.
From HitpipeMajor Require Crossing CrossingMesh CrossingRay FaceAhead Tetrahedron.
Import ListNotations.
Open Scope Z_scope.

(* ---- Points of space, from the origin ---- *)

(* The origin is on the closed triangle: a mean of the corners, with integers as weights. *)
Definition holds_origin (p q r : Vector) : Prop :=
  exists a b c, 0 <= a /\ 0 <= b /\ 0 <= c /\ 0 < a + b + c /\ forall k, a * p k + b * q k + c * r k = 0.

Definition volume (p q r : Vector) : Z := dot p (cross q r).

Definition odd_count {T} (part : T -> bool) (l : list T) : bool := Nat.odd (List.length (filter part l)).

(* The origin is strictly inside the tetrahedron of p, q, r and the apex z. *)
Definition inside (z p q r : Vector) : bool :=
  Tetrahedron.inside_signs (Z.sgn (volume p q r)) (Z.sgn (volume z p q)) (Z.sgn (volume z q r))
    (Z.sgn (volume z r p)).

(* ---- The apex ---- *)

(* For N large enough the apex is in no plane of an edge and the origin. *)
Definition apex (N : Z) : Vector := fun k => match k with x => 1 | y => N | z => N * N end.

Definition enough (p q : Vector) : Z :=
  1 + Z.abs (p x) + Z.abs (p y) + Z.abs (p z) + Z.abs (q x) + Z.abs (q y) + Z.abs (q z) +
  Z.abs (cross p q x) + Z.abs (cross p q y) + Z.abs (cross p q z).

Lemma apex_off_plane N a b c :
  Z.abs a < N -> Z.abs b < N -> Z.abs c < N -> a + N * b + N * N * c = 0 -> a = 0 /\ b = 0 /\ c = 0.
Proof. intros HA HB HC Sum. assert (c = 0) by nia. subst c. assert (b = 0) by nia. subst b. lia. Qed.

Lemma apex_off_line N (p : Vector) :
  Z.abs (p x) < N -> Z.abs (p y) < N -> Z.abs (p z) < N ->
  N * p z - N * N * p y = 0 -> p y - N * p x = 0 -> p x = 0 /\ p y = 0 /\ p z = 0.
Proof. intros HX HY HZ Cx Cz. assert (p x = 0) by nia. assert (p y = 0) by nia. nia. Qed.

Lemma apex_off_edge N p q :
  enough p q <= N -> holds_origin (apex N) p q ->
  exists a b, 0 <= a /\ 0 <= b /\ 0 < a + b /\ forall k, a * p k + b * q k = 0.
Proof.
  intros Far [a [b [c [HA [HB [HC [Sum Is]]]]]]].
  pose proof (Is x) as X. pose proof (Is y) as Y. pose proof (Is z) as Z. cbn [apex] in X, Y, Z.
  destruct (Z.eq_dec a 0) as [-> | NotZero].
  { exists b, c. repeat split; try lia. intro k. specialize (Is k). lia. }
  exfalso. unfold enough in Far.
  assert (a * (cross p q x + N * cross p q y + N * N * cross p q z) = 0) as InPlane.
  { transitivity (cross p q x * (a * 1 + b * p x + c * q x) + cross p q y * (a * N + b * p y + c * q y) +
                  cross p q z * (a * (N * N) + b * p z + c * q z)); [cbn [cross]; ring | rewrite X, Y, Z; ring]. }
  apply Z.mul_eq_0 in InPlane. destruct InPlane as [| InPlane]; [contradiction |].
  apply apex_off_plane in InPlane; [| lia | lia | lia]. destruct InPlane as [Cx [Cy Cz]].
  cbn [cross] in Cx, Cy, Cz.
  assert (a * (N * p z - N * N * p y) = 0 /\ a * (p y - N * p x) = 0 /\
          a * (N * q z - N * N * q y) = 0 /\ a * (q y - N * q x) = 0) as [Px [Pz [Qx Qz]]].
  { repeat split.
    - transitivity (p z * (a * N + b * p y + c * q y) - p y * (a * (N * N) + b * p z + c * q z) +
                    c * (p y * q z - p z * q y)); [ring | rewrite Y, Z, Cx; ring].
    - transitivity (p y * (a * 1 + b * p x + c * q x) - p x * (a * N + b * p y + c * q y) +
                    c * (p x * q y - p y * q x)); [ring | rewrite X, Y, Cz; ring].
    - transitivity (q z * (a * N + b * p y + c * q y) - q y * (a * (N * N) + b * p z + c * q z) -
                    b * (p y * q z - p z * q y)); [ring | rewrite Y, Z, Cx; ring].
    - transitivity (q y * (a * 1 + b * p x + c * q x) - q x * (a * N + b * p y + c * q y) -
                    b * (p x * q y - p y * q x)); [ring | rewrite X, Y, Cz; ring]. }
  apply Z.mul_eq_0_r in Px, Pz, Qx, Qz; try assumption.
  apply apex_off_line in Px; [| lia | lia | lia | exact Pz].
  apply apex_off_line in Qx; [| lia | lia | lia | exact Qz].
  destruct Px as [Px _], Qx as [Qx _]. rewrite Px, Qx in X. lia.
Qed.

(* ---- A view ---- *)

(* A point as a ray sees it from its origin, in ray axes as in CrossingRay.v. The direction d has a component along
   the major axis, which is x there; the ray goes against d if `back` holds. *)
Definition view (major : Axis) (back : bool) (d point : Vector) : FaceAhead.Point :=
  let p := vector_in_ray_axes major point in
  {| FaceAhead.place := {| Crossing.A := d x * p y - d y * p x; Crossing.B := d x * p z - d z * p x |};
     FaceAhead.height := if back then - p x else p x |}.

Section View.
Variables (major : Axis) (back : bool) (d : Vector).
Hypothesis Forward : d x <> 0.

Let see := view major back d.
Let scale : Z := (if back then -1 else 1) * (match major with x => 1 | _ => -1 end) * (d x * d x).

Lemma volume_in_view p q r : FaceAhead.volume (see p) (see q) (see r) = scale * volume p q r.
Proof using.
  unfold FaceAhead.volume, see, view, Crossing.edge, volume, dot, scale, vector_in_ray_axes.
  destruct major, back; cbn [FaceAhead.place FaceAhead.height Crossing.A Crossing.B cross ray_axis axis_a axis_b];
    ring.
Qed.

Lemma inside_in_view z p q r : Tetrahedron.inside (see z) (see p) (see q) (see r) = inside z p q r.
Proof using Forward.
  unfold Tetrahedron.inside, inside. rewrite !volume_in_view, !Z.sgn_mul.
  assert (Z.sgn scale = 1 \/ Z.sgn scale = -1) as [-> | ->] by (unfold scale; destruct major, back; nia);
    unfold Tetrahedron.inside_signs, Tetrahedron.differ; lia.
Qed.

Lemma origin_in_view p q r : FaceAhead.holds_origin (see p) (see q) (see r) -> holds_origin p q r.
Proof using Forward.
  intros [a [b [c [HA [HB [HC [Sum [OfA [OfB OfH]]]]]]]]]. exists a, b, c. repeat (split; [assumption |]).
  unfold see in *. cbn [view FaceAhead.place FaceAhead.height Crossing.A Crossing.B] in *.
  set (sum := fun k => a * p k + b * q k + c * r k).
  assert (sum (ray_axis major x) = 0) as X by (unfold sum, vector_in_ray_axes in *; destruct back; lia).
  assert (d x * sum (ray_axis major y) = 0) as Y
    by (transitivity (d y * sum (ray_axis major x)); [unfold sum, vector_in_ray_axes in *; lia | rewrite X; ring]).
  assert (d x * sum (ray_axis major z) = 0) as Z
    by (transitivity (d z * sum (ray_axis major x)); [unfold sum, vector_in_ray_axes in *; lia | rewrite X; ring]).
  apply Z.mul_eq_0_r in Y, Z; try assumption. intros []; destruct major; assumption.
Qed.
End View.

(* ---- A mesh ---- *)

Section Mesh.
Variables (Corner : Type) (same : forall c d : Corner, {c = d} + {c <> d}) (position : Corner -> Vector).

(* Crossed at a distance T >= 0. *)
Definition crossed_ahead (major : Axis) (back : bool) (d : Vector) (t : CrossingMesh.Triangle Corner) : bool :=
  let '(c, e, f) := t in
  let p := view major back d (position c) in
  let q := view major back d (position e) in
  let r := view major back d (position f) in
  Crossing.crosses (FaceAhead.place p) (FaceAhead.place q) (FaceAhead.place r) && FaceAhead.ahead p q r.

Definition origin_is_off (mesh : list (CrossingMesh.Triangle Corner)) : Prop :=
  forall c e f, In (c, e, f) mesh -> ~ holds_origin (position c) (position e) (position f).

Definition inside_of (apex : Vector) (t : CrossingMesh.Triangle Corner) : bool :=
  let '(c, e, f) := t in inside apex (position c) (position e) (position f).

Definition apex_is_off (apex : Vector) (mesh : list (CrossingMesh.Triangle Corner)) : Prop :=
  forall c e f, In (c, e, f) mesh ->
    ~ holds_origin apex (position c) (position e) /\ ~ holds_origin apex (position e) (position f) /\
    ~ holds_origin apex (position f) (position c).

Lemma apex_exists mesh : origin_is_off mesh -> exists apex, apex_is_off apex mesh.
Proof using.
  intro Off.
  assert (exists N, forall c e f, In (c, e, f) mesh ->
            enough (position c) (position e) <= N /\ enough (position e) (position f) <= N /\
            enough (position f) (position c) <= N) as [N Far].
  { clear Off. induction mesh as [| [[c e] f] mesh [N IH]]; [exists 0; intros ? ? ? [] |].
    exists (Z.max N (Z.max (enough (position c) (position e))
              (Z.max (enough (position e) (position f)) (enough (position f) (position c))))).
    intros c' e' f' [Is | Rest]; [injection Is as <- <- <-; lia |]. specialize (IH c' e' f' Rest). lia. }
  exists (apex N). intros c e f Member. specialize (Off c e f Member).
  destruct (Far c e f Member) as [Fce [Fef Ffc]].
  repeat split; intro On; apply Off;
    (apply apex_off_edge in On; [| assumption]); destruct On as [a [b [HA [HB [Sum Is]]]]].
  - exists a, b, 0. repeat split; try lia. intro k. specialize (Is k). lia.
  - exists 0, a, b. repeat split; try lia. intro k. specialize (Is k). lia.
  - exists b, 0, a. repeat split; try lia. intro k. specialize (Is k). lia.
Qed.

(* Odd or even is what the tetrahedra say, and they do not know the direction. *)
Section Direction.
Variables (major : Axis) (back : bool) (d : Vector) (top : Vector).
Hypothesis Forward : d x <> 0.

Let seen (c : Corner) : FaceAhead.Point := view major back d (position c).
Let face (t : CrossingMesh.Triangle Corner) : Z :=
  let '(c, e, f) := t in FaceAhead.sign_ahead (seen c) (seen e) (seen f).
Let side (edge : CrossingMesh.Edge Corner) : Z :=
  FaceAhead.sign_ahead (view major back d top) (seen (fst edge)) (seen (snd edge)).

Lemma tetrahedra_are mesh :
  origin_is_off mesh -> apex_is_off top mesh ->
  (2 | CrossingMesh.total face mesh - CrossingMesh.total side (CrossingMesh.edges Corner mesh) -
       Z.of_nat (List.length (filter (inside_of top) mesh))).
Proof using Forward.
  induction mesh as [| [[c e] f] mesh IH]; intros Off ApexOff; [exists 0; reflexivity |].
  destruct IH as [h IH].
  { intros c' e' f' Member. apply Off. right. exact Member. }
  { intros c' e' f' Member. apply ApexOff. right. exact Member. }
  specialize (Off c e f (or_introl eq_refl)). specialize (ApexOff c e f (or_introl eq_refl)).
  assert (Tetrahedron.off_faces (view major back d top) (seen c) (seen e) (seen f)) as OffFaces.
  { destruct ApexOff as [First [Second Third]]. unfold Tetrahedron.off_faces, seen.
    repeat split; intro On; apply origin_in_view in On; auto. }
  pose proof (Tetrahedron.faces_ahead_are_odd_inside _ _ _ _ OffFaces) as Odd. unfold seen in Odd.
  rewrite inside_in_view in Odd by exact Forward. fold (seen c) (seen e) (seen f) in Odd.
  unfold CrossingMesh.edges. cbn [flat_map]. rewrite CrossingMesh.total_of_both.
  fold (CrossingMesh.edges Corner mesh). cbn [filter inside_of].
  cbn [CrossingMesh.total fold_right face CrossingMesh.edges_of]. fold (CrossingMesh.total face mesh).
  set (sides := CrossingMesh.total side (CrossingMesh.edges Corner mesh)) in *.
  cbn [CrossingMesh.total fold_right]. unfold side. cbn [fst snd].
  set (n := FaceAhead.sign_ahead (seen c) (seen e) (seen f) - _ - _ - _) in Odd.
  pose proof (Z.div2_odd n) as Half. rewrite Odd in Half.
  exists (h + Z.div2 n).
  destruct (inside top (position c) (position e) (position f)); cbn [List.length Z.b2z] in *; unfold n in *; lia.
Qed.

Lemma ahead_are mesh :
  (2 | CrossingMesh.total face mesh - Z.of_nat (List.length (filter (crossed_ahead major back d) mesh))).
Proof using.
  induction mesh as [| [[c e] f] mesh [h IH]]; [exists 0; reflexivity |].
  cbn [CrossingMesh.total fold_right filter crossed_ahead]. fold (CrossingMesh.total face mesh).
  fold (seen c) (seen e) (seen f). unfold face at 1, FaceAhead.sign_ahead, FaceAhead.sign_of_face.
  destruct (FaceAhead.ahead _ _ _); [| rewrite andb_false_r; exists h; lia]. rewrite andb_true_r.
  destruct (Crossing.crossing_sign_is (FaceAhead.place (seen c)) (FaceAhead.place (seen e))
              (FaceAhead.place (seen f))) as [Sign | [Sign | [Sign Not]]];
    rewrite Crossing.crosses_by_sign, Sign; cbn [Z.eqb negb List.length];
    [exists h | exists (h - 1) | exists h]; lia.
Qed.

Lemma ahead_as_inside mesh :
  CrossingMesh.closed Corner same mesh -> origin_is_off mesh -> apex_is_off top mesh ->
  odd_count (crossed_ahead major back d) mesh = odd_count (inside_of top) mesh.
Proof using Forward.
  intros Closed Off ApexOff.
  destruct (tetrahedra_are mesh Off ApexOff) as [h Tetrahedra], (ahead_are mesh) as [k Ahead].
  assert (2 | CrossingMesh.total side (CrossingMesh.edges Corner mesh)) as [l Sides].
  { apply (CrossingMesh.total_of_edges Corner same).
    - intros c e. apply FaceAhead.sign_ahead_turned.
    - intros c e. apply CrossingMesh.surplus_of_closed. exact Closed. }
  unfold odd_count. set (m := List.length (filter (crossed_ahead major back d) mesh)) in *.
  set (n := List.length (filter (inside_of top) mesh)) in *.
  assert (Nat.Even (m + n)) as Even by (exists (Z.to_nat (Z.of_nat n + h + l - k)); lia).
  apply Nat.even_spec in Even. rewrite Nat.even_add in Even. rewrite <- !Nat.negb_even.
  apply eqb_prop in Even. rewrite Even. reflexivity.
Qed.
End Direction.

(* For any two directions, each with its own order of axes. *)
Theorem count_ahead_is_of_origin major back d major' back' d' mesh :
  d x <> 0 -> d' x <> 0 -> CrossingMesh.closed Corner same mesh -> origin_is_off mesh ->
  odd_count (crossed_ahead major back d) mesh = odd_count (crossed_ahead major' back' d') mesh.
Proof using.
  intros Forward Forward' Closed Off. destruct (apex_exists mesh Off) as [top ApexOff].
  rewrite !(ahead_as_inside _ _ _ top) by assumption. reflexivity.
Qed.
End Mesh.

(* ---- A ray ---- *)

(* The rule, and the hit ahead: -num has det's sign or is 0, as in TriangleHit.v. *)
Definition ray_crosses_ahead (g : Z) (major : Axis) (ray : IntegerRay) (t : Corners) : bool :=
  CrossingRay.ray_crosses g major ray t && (0 <=? det t (step_of ray) * - num g t (start ray)).

Definition corners (a b c : Vector) : Corners := {| corner0 := a; corner1 := b; corner2 := c |}.

Lemma ray_crosses_ahead_is g major ray a b c :
  0 <= g -> 0 < slopes ray major ->
  let from_origin := fine_corner g (start ray) in
  ray_crosses_ahead g major ray (corners a b c) =
  let seen p := view major (backward ray major) (CrossingRay.unit_direction major ray) (from_origin p) in
  Crossing.crosses (FaceAhead.place (seen a)) (FaceAhead.place (seen b)) (FaceAhead.place (seen c)) &&
  FaceAhead.ahead (seen a) (seen b) (seen c).
Proof.
  intros G Major. cbv zeta. set (d := CrossingRay.unit_direction major ray).
  assert (0 < d x) as Forward by (unfold d; rewrite CrossingRay.unit_direction_is_forward; exact Major).
  unfold ray_crosses_ahead, FaceAhead.ahead. f_equal. rewrite volume_in_view.
  assert (volume (fine_corner g (start ray) a) (fine_corner g (start ray) b) (fine_corner g (start ray) c) =
          2 ^ g * 2 ^ g * num g (corners a b c) (start ray)) as ->.
  { unfold volume, num, aside, to_corner0, fine_corner, edge1, edge2, minus, dot, corners.
    cbn [cross corner0 corner1 corner2]. ring. }
  destruct (CrossingRay.edges_seen g (corners_in_ray_axes major (corners a b c))
              (vector_in_ray_axes major (start ray)) d) as [_ [_ [_ Det]]].
  match goal with |- _ = (0 <=? _ * ?seen) => change seen with (Crossing.det
    (CrossingRay.seen g (vector_in_ray_axes major (start ray)) d (vector_in_ray_axes major a))
    (CrossingRay.seen g (vector_in_ray_axes major (start ray)) d (vector_in_ray_axes major b))
    (CrossingRay.seen g (vector_in_ray_axes major (start ray)) d (vector_in_ray_axes major c))) end.
  cbn [corners_in_ray_axes corners corner0 corner1 corner2] in Det. rewrite Det.
  destruct (CrossingRay.unit_numbers g major ray (corners a b c)) as [Turned _]. fold d in Turned.
  cbn [corners_in_ray_axes corners corner0 corner1 corner2] in Turned. rewrite Turned.
  pose proof (power_positive g G) as Fine.
  set (n := num g _ _). set (e := det _ (step_of ray)). clearbody n e d.
  assert (0 < d x * d x * d x * (2 ^ g * 2 ^ g) * (2 ^ g * 2 ^ g)) as Positive by nia.
  set (k := d x * d x * d x * (2 ^ g * 2 ^ g) * (2 ^ g * 2 ^ g)) in *.
  transitivity (0 <=? k * (e * - n)); [clearbody k; nia |]. f_equal. unfold k, CrossingRay.turned.
  destruct major, (backward ray _); cbn [xorb]; ring.
Qed.

(* The weights of a point of the triangle, as rational numbers whose sum is 1. *)
Lemma holds_origin_is f o a b c :
  0 <= finer f ->
  let from_origin := fine_corner (finer f) o in
  holds_origin (from_origin a) (from_origin b) (from_origin c) ->
  in_triangle f (corners a b c) (fun k => inject_Z (o k)).
Proof.
  cbv zeta. intros G [l [m [n [L [M [N [Sum Is]]]]]]].
  assert (0 < inject_Z (l + m + n))%Q as Positive by (change 0%Q with (inject_Z 0); rewrite <- Zlt_Qlt; exact Sum).
  rewrite !inject_Z_plus in Positive. rewrite Zle_Qle in L, M, N. change (inject_Z 0) with 0%Q in *.
  set (total := (inject_Z l + inject_Z m + inject_Z n)%Q) in *.
  assert (~ total == 0)%Q as NotZero by lra.
  exists (inject_Z l / total)%Q, (inject_Z m / total)%Q, (inject_Z n / total)%Q.
  repeat split; try (apply Qle_shift_div_l; lra).
  - unfold total. field. exact NotZero.
  - intro k. specialize (Is k). apply inject_Z_injective in Is. unfold fine_corner in Is.
    repeat first [rewrite inject_minus in Is | rewrite inject_Z_plus in Is | rewrite inject_Z_mult in Is].
    rewrite pow2_integer in Is by exact G. change (inject_Z 0) with 0%Q in Is.
    cbn [corners corner0 corner1 corner2].
    apply (Qmult_inj_r _ _ total NotZero).
    setoid_replace (pow2 (finer f) * (inject_Z l / total * inject_Z (a k) + inject_Z m / total * inject_Z (b k) +
                                      inject_Z n / total * inject_Z (c k)) * total)%Q
      with (pow2 (finer f) * (inject_Z l * inject_Z (a k) + inject_Z m * inject_Z (b k) +
                              inject_Z n * inject_Z (c k)))%Q by (field; exact NotZero).
    unfold total. lra.
Qed.

(* The headline: two rays from one origin, on no triangle of a closed mesh, count as odd or as even both. *)
Theorem origin_is_inside_or_outside (Corner : Type) (same : forall c d : Corner, {c = d} + {c <> d})
    (position : Corner -> Vector) f major ray major' ray' mesh :
  let triangle t := CrossingRay.triangle_of Corner position t in
  let odd major ray := odd_count (fun t => ray_crosses_ahead (finer f) major ray (triangle t)) mesh in
  0 <= finer f -> 0 < slopes ray major -> 0 < slopes ray' major' -> start ray = start ray' ->
  CrossingMesh.closed Corner same mesh ->
  (forall t, In t mesh -> ~ in_triangle f (triangle t) (fun k => inject_Z (start ray k))) ->
  odd major ray = odd major' ray'.
Proof.
  cbv beta zeta. unfold odd_count. intros G Major Major' Start Closed Off. set (g := finer f) in *.
  set (from_origin := fun c => fine_corner g (start ray) (position c)).
  assert (forall major ray', 0 < slopes ray' major -> start ray = start ray' ->
            filter (fun t => ray_crosses_ahead g major ray' (CrossingRay.triangle_of Corner position t)) mesh =
            filter (crossed_ahead Corner from_origin major (backward ray' major)
                      (CrossingRay.unit_direction major ray')) mesh) as Counts.
  { clear major major' ray' Major Major' Start. intros major ray' Major Start. apply filter_ext.
    intros [[c d] e].
    pose proof (ray_crosses_ahead_is g major ray' (position c) (position d) (position e) G Major) as Is.
    cbv zeta in Is. rewrite <- Start in Is. exact Is. }
  rewrite (Counts major ray), (Counts major' ray') by (assumption || reflexivity).
  apply (count_ahead_is_of_origin Corner same); [| | exact Closed |].
  - rewrite CrossingRay.unit_direction_is_forward. lia.
  - rewrite CrossingRay.unit_direction_is_forward. lia.
  - intros c d e Member On. apply (Off (c, d, e) Member). apply (holds_origin_is f); assumption.
Qed.
