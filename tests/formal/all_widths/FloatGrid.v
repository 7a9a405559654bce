(* The integer code of fine_grid.hpp and of the ray's length computes the definitions.
   A float is k 2^-s. Where the C++ has a path by doubles (n <= 31), this file says nothing about doubles:
   `lower_from_floor` takes their exact product as given. *)
From Coq Require Import ZArith QArith Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor SetUp.
Open Scope Z_scope.

(* The widest format of the program, and a binary32 mantissa. *)
Record of_program (f : Format) : Prop := {
  program_coord : coord f <= 32;
  program_finer : finer f <= 3;
  program_fraction : fraction f <= 3
}.
Definition binary32_mantissa (k : Z) : Prop := Z.abs k < 2 ^ 24.

Definition fixed_point (k s : Z) : Q := (inject_Z k * pow2 (- s))%Q.

(* fine_nearest: floor(G 2^g x + 1/2). *)
Definition fine_nearest f (k s : Z) : Z :=
  if 60 <? s then 0
  else (largest_point f * 2 ^ (finer f + 1) * k + 2 ^ s) / 2 ^ (s + 1).

(* fine_lower: floor(G x - 2^-(g+1)). *)
Definition fine_lower f (k s : Z) : Z :=
  if 58 <? s then -1
  else (largest_point f * 2 ^ (finer f + 1) * k - 2 ^ s) / 2 ^ (s + (finer f + 1)).

(* 2 G 2^g k has at most 58 bits. *)
Lemma magnitude_bound f k :
  valid f -> of_program f -> binary32_mantissa k ->
  Z.abs (largest_point f * 2 ^ (finer f + 1) * k) < 2 ^ 58.
Proof.
  intros [] [] K. unfold binary32_mantissa in K. unfold largest_point.
  pose proof (power_positive (coord f - 2) ltac:(lia)). pose proof (power_positive (finer f + 1) ltac:(lia)).
  assert (2 ^ (coord f - 2) <= 2 ^ 30) by (apply Z.pow_le_mono_r; lia).
  assert (2 ^ (finer f + 1) <= 2 ^ 4) by (apply Z.pow_le_mono_r; lia).
  set (G := 2 ^ (coord f - 2)) in *. set (g := 2 ^ (finer f + 1)) in *.
  rewrite Z.abs_mul, (Z.abs_eq ((G - 1) * g)) by nia.
  change (2 ^ 58) with (2 ^ 30 * 2 ^ 4 * 2 ^ 24). nia.
Qed.

Theorem fine_nearest_is f k s :
  valid f -> of_program f -> binary32_mantissa k -> 0 <= s ->
  fine_nearest f k s = Qfloor (on_fine_grid f (fixed_point k s) + (1 # 2)).
Proof.
  intros V Program K Hs. pose proof (magnitude_bound f k V Program K) as Bound.
  assert (0 <= finer f) by (destruct V; assumption).
  transitivity ((largest_point f * 2 ^ (finer f + 1) * k + 2 ^ s) / 2 ^ (s + 1)).
  - unfold fine_nearest. destruct (Z.ltb_spec 60 s); [| reflexivity].
    assert (2 ^ 58 <= 2 ^ s) by (apply Z.pow_le_mono_r; lia).
    symmetry. apply Z.div_small. rewrite (power_sum s 1) by lia. change (2 ^ 1) with 2. lia.
  - rewrite <- floor_of_quotient by lia. apply Qfloor_comp. unfold on_fine_grid, fixed_point.
    rewrite inject_Z_plus, !inject_Z_mult, !pow2_integer by lia.
    replace (- (s + 1)) with (- s + - (1)) by lia. rewrite !pow2_plus, pow2_1.
    setoid_replace (pow2 (- (1))) with (1 # 2)%Q by reflexivity.
    pose proof (pow2_cancel s) as Cancel.
    setoid_replace ((inject_Z (largest_point f) * (pow2 (finer f) * 2) * inject_Z k + pow2 s) *
                    (pow2 (- s) * (1 # 2)))%Q
      with (inject_Z (largest_point f) * pow2 (finer f) * (inject_Z k * pow2 (- s)) +
            (1 # 2) * (pow2 s * pow2 (- s)))%Q by ring.
    rewrite Cancel. ring.
Qed.

Theorem fine_lower_is f k s :
  valid f -> of_program f -> binary32_mantissa k -> 0 <= s ->
  fine_lower f k s = lower f (fixed_point k s).
Proof.
  intros V Program K Hs. pose proof (magnitude_bound f k V Program K) as Bound.
  assert (0 <= finer f) by (destruct V; assumption).
  transitivity ((largest_point f * 2 ^ (finer f + 1) * k - 2 ^ s) / 2 ^ (s + (finer f + 1))).
  - unfold fine_lower. destruct (Z.ltb_spec 58 s); [| reflexivity].
    assert (2 ^ 58 <= 2 ^ s) by (apply Z.pow_le_mono_r; lia).
    assert (2 * 2 ^ s <= 2 ^ (s + (finer f + 1))).
    { rewrite <- Z.pow_succ_r by lia. apply Z.pow_le_mono_r; lia. }
    set (v := largest_point f * 2 ^ (finer f + 1) * k) in *.
    apply Z.div_unique with (v - 2 ^ s + 2 ^ (s + (finer f + 1))); lia.
  - rewrite <- floor_of_quotient by lia. apply Qfloor_comp. unfold fixed_point.
    rewrite inject_minus, !inject_Z_mult, !pow2_integer by lia.
    replace (- (s + (finer f + 1))) with (- s + - (finer f + 1)) by lia. rewrite (pow2_plus (- s)).
    pose proof (pow2_cancel s) as Cancel. pose proof (pow2_cancel (finer f + 1)) as Cancel'.
    setoid_replace ((inject_Z (largest_point f) * pow2 (finer f + 1) * inject_Z k - pow2 s) *
                    (pow2 (- s) * pow2 (- (finer f + 1))))%Q
      with (inject_Z (largest_point f) * (inject_Z k * pow2 (- s)) *
              (pow2 (finer f + 1) * pow2 (- (finer f + 1))) -
            pow2 (- (finer f + 1)) * (pow2 s * pow2 (- s)))%Q by ring.
    rewrite Cancel, Cancel'. ring.
Qed.

(* The path by doubles: from the floor of the exact product G 2^(g+1) x. *)
Theorem lower_from_floor f c :
  valid f ->
  (Qfloor (inject_Z (largest_point f * 2 ^ (finer f + 1)) * c) - 1) / 2 ^ (finer f + 1) = lower f c.
Proof.
  intros []. set (j := finer f + 1). set (p := (inject_Z (largest_point f * 2 ^ j) * c)%Q).
  assert (0 <= j) by (unfold j; lia). pose proof (power_positive j ltac:(lia)) as Power.
  pose proof (pow2_positive j) as PositiveJ. pose proof (pow2_cancel j) as Cancel.
  assert ((inject_Z (largest_point f) * c - pow2 (- j)) * pow2 j == p - 1)%Q as Scaled.
  { unfold p. rewrite inject_Z_mult, pow2_integer by lia.
    setoid_replace ((inject_Z (largest_point f) * c - pow2 (- j)) * pow2 j)%Q with
      (inject_Z (largest_point f) * pow2 j * c - pow2 j * pow2 (- j))%Q by ring.
    rewrite Cancel. reflexivity. }
  unfold lower. fold j. set (low := (inject_Z (largest_point f) * c - pow2 (- j))%Q) in *.
  apply Z.le_antisymm.
  - (* floor(p) - 1 <= p - 1 *)
    rewrite <- floor_of_quotient by lia. apply Qfloor_resp_le. rewrite inject_minus, inject_1.
    pose proof (floor_below p). pose proof (pow2_positive (- j)).
    setoid_replace low with ((p - 1) * pow2 (- j))%Q; [nra |].
    rewrite <- Scaled.
    setoid_replace (low * pow2 j * pow2 (- j))%Q with (low * (pow2 j * pow2 (- j)))%Q by ring.
    rewrite Cancel. ring.
  - apply Z.div_le_lower_bound; [lia |]. enough (2 ^ j * Qfloor low + 1 <= Qfloor p) by lia.
    apply below_floor. rewrite inject_Z_plus, inject_Z_mult, pow2_integer by lia.
    change (inject_Z 1) with 1%Q. pose proof (floor_below low). nra.
Qed.

(* upper(x) = -fine_lower(-x), and a forward origin is -fine_nearest(-x). *)
Theorem upper_is f c : upper f c = - lower f (- c).
Proof.
  unfold upper, lower, Qceiling. f_equal. apply Qfloor_comp. ring.
Qed.

Theorem origin_word_is f (back : bool) c :
  let nearest c := Qfloor (on_fine_grid f c + (1 # 2)) in
  origin_word f back c = if back then - nearest c - 1 else - nearest (- c)%Q.
Proof.
  cbv zeta. unfold origin_word, Qceiling. destruct back; [reflexivity |].
  f_equal. apply Qfloor_comp. unfold on_fine_grid. ring.
Qed.

(* ---- Length ---- *)

(* length = k 2^e and |D_M| = k' 2^e' *)
Definition float_length f (k e k' e' : Z) : Z :=
  let largest := largest_length f in
  let product := largest_point f * k * k' in
  let exponent := e + e' + fraction f in
  if (product =? 0) || (exponent <=? -128) then 0
  else if 40 <=? exponent then largest
  else let full := if exponent <? 0 then product / 2 ^ (- exponent) else product * 2 ^ exponent in
       Z.min full largest.

Theorem float_length_is f k e k' e' :
  valid f -> of_program f -> 0 <= k < 2 ^ 24 -> 0 <= k' < 2 ^ 24 ->
  float_length f k e k' e' =
  length_word f (inject_Z k' * pow2 e') (Some (inject_Z k * pow2 e)%Q).
Proof.
  intros V [] K K'. unfold float_length. cbn [length_word]. cbv zeta.
  set (product := largest_point f * k * k'). set (exponent := e + e' + fraction f).
  pose proof (grid_positive f V) as G. destruct V.
  assert (0 <= largest_length f < 2 ^ 40) as Largest.
  { unfold largest_length. pose proof (power_positive (coord f + fraction f - 1) ltac:(lia)).
    assert (2 ^ (coord f + fraction f - 1) <= 2 ^ 34) by (apply Z.pow_le_mono_r; lia).
    assert (2 ^ 34 < 2 ^ 40) by reflexivity. lia. }
  assert (0 <= product < 2 ^ 78) as Product.
  { assert (largest_point f < 2 ^ 30) as GBound.
    { unfold largest_point. assert (2 ^ (coord f - 2) <= 2 ^ 30) by (apply Z.pow_le_mono_r; lia). lia. }
    unfold product. change (2 ^ 78) with (2 ^ 30 * (2 ^ 24 * 2 ^ 24)). rewrite <- Z.mul_assoc.
    assert (0 <= k * k' < 2 ^ 24 * 2 ^ 24) by nia. set (kk := k * k') in *. clearbody kk.
    assert (0 < 2 ^ 24 * 2 ^ 24) by reflexivity. nia. }
  assert (inject_Z k * pow2 e * (inject_Z k' * pow2 e') * inject_Z (largest_point f) * pow2 (fraction f) ==
          inject_Z product * pow2 exponent)%Q as Value.
  { unfold product, exponent. rewrite !inject_Z_mult, !pow2_plus. ring. }
  rewrite (Qfloor_comp _ _ Value). clear Value.
  assert (Qfloor (inject_Z product * pow2 exponent) =
          if exponent <? 0 then product / 2 ^ (- exponent) else product * 2 ^ exponent) as Full.
  { destruct (Z.ltb_spec exponent 0).
    - rewrite <- floor_of_quotient by lia. rewrite Z.opp_involutive. reflexivity.
    - rewrite <- (Qfloor_Z (product * 2 ^ exponent)). apply Qfloor_comp.
      rewrite inject_Z_mult, pow2_integer by lia. reflexivity. }
  rewrite Full.
  destruct (Z.eqb_spec product 0) as [-> | NotZero]; cbn [orb].
  { destruct (Z.ltb_spec exponent 0); rewrite ?Z.mul_0_l; [| lia].
    rewrite Z.div_0_l by (apply Z.pow_nonzero; lia). lia. }
  destruct (Z.leb_spec exponent (-128)) as [Small |].
  { destruct (Z.ltb_spec exponent 0); [| lia].
    rewrite Z.div_small; [lia |]. assert (2 ^ 78 <= 2 ^ (- exponent)) by (apply Z.pow_le_mono_r; lia). lia. }
  destruct (Z.leb_spec 40 exponent) as [Large |]; [| reflexivity].
  destruct (Z.ltb_spec exponent 0); [lia |].
  assert (2 ^ 40 <= 2 ^ exponent) by (apply Z.pow_le_mono_r; lia). nia.
Qed.
