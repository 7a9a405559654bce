(* The integer code of int_major_ray.cpp computes the quotient's definition.
   A float is mantissa 2^exponent. Its mantissa has any number of bits, and the leading one is 1. *)
From Coq Require Import ZArith QArith Qround Lia Lqa Bool.
From HitpipeMajor Require Import Numbers IntMajor SetUp.
Open Scope Z_scope.

Record Normal := { float_mantissa : Z; float_exponent : Z }.

Definition value (x : Normal) : Q := (inject_Z (float_mantissa x) * pow2 (float_exponent x))%Q.

Definition normal (bits : Z) (x : Normal) : Prop := 2 ^ (bits - 1) <= float_mantissa x < 2 ^ bits.

(* `quotient` of int_major_ray.cpp, for a component that is not 0. *)
Definition float_quotient f (above below : Normal) : MajorQuotient :=
  let largest := largest_mantissa f in
  let too_large := too_large f (largest_exponent f) in
  let halved := if float_mantissa above <? float_mantissa below then 1 else 0 in
  let exponent := float_exponent above - float_exponent below - halved in
  if largest_exponent f <? exponent then too_large
  else
    let numerator := float_mantissa above * 2 ^ (mantissa f - 1 + halved) in
    let low := numerator / float_mantissa below in
    let exact := numerator mod float_mantissa below =? 0 in
    if exact then {| mantissa_low := low; mantissa_high := low; exponent := exponent |}
    else if low <? largest then {| mantissa_low := low; mantissa_high := low + 1; exponent := exponent |}
    else if exponent =? largest_exponent f then too_large
    else {| mantissa_low := largest / 2; mantissa_high := largest / 2 + 1; exponent := exponent + 1 |}.

(* ---- How to recognise the smallest exponent ---- *)

Lemma quotient_found f cap major other e :
  ~ (other == 0)%Q -> 0 <= e <= cap -> fits f major other e = true ->
  (forall smaller, 0 <= smaller < e -> fits f major other smaller = false) ->
  quotient f cap major other =
  {| mantissa_low := Qfloor (scaled_quotient f major other e);
     mantissa_high := Qceiling (scaled_quotient f major other e);
     exponent := e |}.
Proof.
  intros NotZero Range Fits Smaller. unfold quotient.
  destruct (Qeq_bool other 0) eqn:Zero; [apply Qeq_bool_iff in Zero; contradiction |].
  destruct (smallest_exponent _ _ _ _ _) as [found |] eqn:Search.
  - apply smallest_exponent_found in Search. destruct Search as [RangeF [FitsF SmallerF]].
    assert (found = e) as ->; [| reflexivity].
    destruct (Z.lt_trichotomy found e) as [Less | [Same | More]]; [| exact Same |].
    + rewrite Smaller in FitsF by lia. discriminate.
    + rewrite SmallerF in Fits by lia. discriminate.
  - rewrite (smallest_exponent_none _ _ _ _ _ Search) in Fits by lia. discriminate.
Qed.

Lemma quotient_not_found f cap major other :
  (forall e, 0 <= e <= cap -> fits f major other e = false) ->
  quotient f cap major other = too_large f cap.
Proof.
  intros None. unfold quotient. destruct (Qeq_bool other 0); [reflexivity |].
  destruct (smallest_exponent _ _ _ _ _) as [found |] eqn:Search; [| reflexivity].
  apply smallest_exponent_found in Search. destruct Search as [Range [Fits _]].
  rewrite None in Fits by lia. discriminate.
Qed.

Lemma scaled_quotient_at f major other e e' :
  (scaled_quotient f major other e == scaled_quotient f major other e' * pow2 (e' - e))%Q.
Proof.
  unfold scaled_quotient. replace (- e) with (- e' + (e' - e)) by lia. rewrite pow2_plus. ring.
Qed.

Lemma does_not_fit f major other e :
  (inject_Z (largest_mantissa f) < scaled_quotient f major other e)%Q -> fits f major other e = false.
Proof.
  intro H. unfold fits. apply Z.leb_gt. rewrite Zlt_Qlt.
  pose proof (ceiling_above (scaled_quotient f major other e)). lra.
Qed.

Theorem float_quotient_is_quotient :
  forall (f : Format) (bits : Z) (above below : Normal),
    valid f -> 1 <= bits -> normal bits above -> normal bits below -> (value below <= value above)%Q ->
    float_quotient f above below = quotient f (largest_exponent f) (value above) (value below).
Proof.
  intros f bits above below V Hbits Above Below Order. unfold float_quotient. cbv zeta.
  assert (1 <= mantissa f) as Hp by (destruct V; assumption).
  unfold normal in *. pose proof (twice_power bits Hbits) as Twice.
  pose proof (power_positive (bits - 1) ltac:(lia)) as PowerBits.
  set (A := float_mantissa above) in *. set (B := float_mantissa below) in *.
  set (halved := if A <? B then 1 else 0).
  set (e := float_exponent above - float_exponent below - halved).
  set (N := A * 2 ^ (mantissa f - 1 + halved)).
  pose proof (power_positive (mantissa f - 1) ltac:(lia)) as PowerM.
  set (M := 2 ^ (mantissa f - 1)) in *.
  assert (largest_mantissa f = 2 * M - 1) as Largest by (apply largest_mantissa_is; exact Hp).
  assert (halved = 0 \/ halved = 1) as Halved by (unfold halved; destruct (A <? B); auto).
  (* N / B is in [2^(p-1), 2^p). *)
  assert (M * B <= N < 2 * M * B) as Range.
  { unfold N. rewrite power_sum by lia. fold M. unfold halved. destruct (Z.ltb_spec A B).
    - change (2 ^ 1) with 2. nia.
    - change (2 ^ 0) with 1. nia. }
  set (major := value above) in *. set (other := value below) in *.
  assert (0 < inject_Z B)%Q as BPositive. { change 0%Q with (inject_Z 0). rewrite <- Zlt_Qlt. lia. }
  assert (0 < other)%Q as Positive.
  { unfold other, value. fold B. pose proof (pow2_positive (float_exponent below)). nra. }
  set (sq := scaled_quotient f major other).
  assert (sq e * inject_Z B == inject_Z N)%Q as Exact.
  { pose proof (scaled_quotient_is f major other e Positive) as Eq. fold sq in Eq.
    unfold major, other, value in Eq. fold A B in Eq.
    assert (pow2 e * pow2 (float_exponent below) * pow2 halved == pow2 (float_exponent above))%Q as Exponents.
    { rewrite <- !pow2_plus. unfold e. replace (_ + _ + _) with (float_exponent above) by lia. reflexivity. }
    pose proof (pow2_positive e). pose proof (pow2_positive (float_exponent below)).
    apply Qmult_inj_r with (pow2 e * pow2 (float_exponent below))%Q; [nra |].
    unfold N. rewrite inject_Z_mult, pow2_integer, (pow2_plus (mantissa f - 1)) by lia.
    setoid_replace (sq e * inject_Z B * (pow2 e * pow2 (float_exponent below)))%Q with
      (sq e * (pow2 e * (inject_Z B * pow2 (float_exponent below))))%Q by ring.
    rewrite Eq, <- Exponents. ring. }
  assert (inject_Z M <= sq e)%Q as Above1.
  { destruct Range as [Low _]. rewrite Zle_Qle, inject_Z_mult in Low.
    apply Qmult_lt_0_le_reg_r with (inject_Z B); [exact BPositive | lra]. }
  assert (sq e < 2 * inject_Z M)%Q as Below2.
  { destruct Range as [_ High]. rewrite Zlt_Qlt, !inject_Z_mult in High.
    change (inject_Z 2) with 2%Q in High. nra. }
  assert (0 < inject_Z M)%Q as MPositive. { change 0%Q with (inject_Z 0). rewrite <- Zlt_Qlt. exact PowerM. }
  assert (inject_Z (largest_mantissa f) == 2 * inject_Z M - 1)%Q as LargestQ.
  { rewrite Largest, inject_minus, inject_Z_mult. reflexivity. }
  (* Smaller exponents do not fit. *)
  assert (forall smaller, smaller < e -> fits f major other smaller = false) as Smaller.
  { intros s Hs. apply does_not_fit. rewrite (scaled_quotient_at f major other s e). fold sq.
    replace (e - s) with (e - s - 1 + 1) by lia. rewrite pow2_plus, pow2_1.
    pose proof (pow2_at_least_1 (e - s - 1) ltac:(lia)). rewrite LargestQ. nra. }
  (* The quotient is at least 1, so the exponent is not negative. *)
  assert (0 <= e) as EPositive.
  { destruct (Z_lt_ge_dec e 0) as [Negative |]; [exfalso | lia].
    pose proof (scaled_quotient_is f major other 0 Positive) as Eq.
    rewrite (scaled_quotient_at f major other 0 e), pow2_0 in Eq. fold sq in Eq.
    replace (e - 0) with (e + 1 + - (1)) in Eq by lia. rewrite pow2_plus in Eq.
    setoid_replace (pow2 (- (1))) with (1 # 2)%Q in Eq by reflexivity.
    rewrite <- (pow2_integer (mantissa f - 1)) in Eq by lia. fold M in Eq.
    pose proof (pow2_negative_below (e + 1) ltac:(lia)). pose proof (pow2_positive (e + 1)).
    assert (sq e * (pow2 (e + 1) * (1 # 2)) < inject_Z M)%Q by nra. nra. }
  assert (~ other == 0)%Q as NotZero by lra.
  pose proof (Z.div_mod N B ltac:(lia)) as Division. pose proof (Z.mod_pos_bound N B ltac:(lia)) as Mod.
  set (low := N / B) in *. set (r := N mod B) in *.
  assert (M <= low < 2 * M) as LowRange by nia.
  assert (sq e * inject_Z B == inject_Z B * inject_Z low + inject_Z r)%Q as Value.
  { rewrite Exact, Division, inject_Z_plus, inject_Z_mult. reflexivity. }
  destruct Mod as [Mod0 Mod1]. rewrite Zlt_Qlt in Mod1.
  destruct (Z.ltb_spec (largest_exponent f) e) as [TooLarge | InRange].
  { symmetry. apply quotient_not_found. intros. apply Smaller. lia. }
  destruct (Z.eqb_spec r 0) as [Zero | Inexact].
  { (* The division is exact. *)
    rewrite Zero in Value. change (inject_Z 0) with 0%Q in Value.
    assert (sq e == inject_Z low)%Q as Integer.
    { apply Qmult_inj_r with (inject_Z B); [lra |]. rewrite Value. ring. }
    assert (Qceiling (sq e) = low) as Ceiling by (apply ceiling_is; rewrite Integer; lra).
    rewrite (quotient_found f (largest_exponent f) major other e NotZero ltac:(lia)).
    - fold sq. rewrite Ceiling. f_equal. symmetry. apply floor_is; rewrite Integer; lra.
    - unfold fits. fold sq. rewrite Ceiling. apply Z.leb_le. lia.
    - intros. apply Smaller. lia. }
  (* The quotient is between low and low + 1. *)
  assert (0 < r) as RPositive by lia. rewrite Zlt_Qlt in RPositive. change (inject_Z 0) with 0%Q in RPositive.
  assert (inject_Z low < sq e)%Q as AboveLow by nra.
  assert (sq e < inject_Z low + 1)%Q as BelowNext by nra.
  assert (Qceiling (sq e) = low + 1) as Ceiling.
  { apply ceiling_is; rewrite inject_Z_plus; change (inject_Z 1) with 1%Q; lra. }
  destruct (Z.ltb_spec low (largest_mantissa f)) as [Fits | Full].
  { rewrite (quotient_found f (largest_exponent f) major other e NotZero ltac:(lia)).
    - fold sq. rewrite Ceiling. f_equal. symmetry. apply floor_is; lra.
    - unfold fits. fold sq. rewrite Ceiling. apply Z.leb_le. lia.
    - intros. apply Smaller. lia. }
  (* The upper mantissa would be 2^p, so this exponent does not fit either. *)
  assert (low = 2 * M - 1) as IsLargest by lia.
  assert (fits f major other e = false) as NotThis.
  { unfold fits. fold sq. rewrite Ceiling. apply Z.leb_gt. lia. }
  destruct (Z.eqb_spec e (largest_exponent f)) as [Last | NotLast].
  { symmetry. apply quotient_not_found. intros s Hs.
    destruct (Z.eq_dec s e) as [-> | Other]; [exact NotThis |].
    apply Smaller. lia. }
  pose proof (scaled_quotient_halves f major other e Positive) as Halves. fold sq in Halves.
  rewrite IsLargest, inject_minus, inject_Z_mult in AboveLow, BelowNext.
  change (inject_Z 1) with 1%Q in *. change (inject_Z 2) with 2%Q in *.
  assert (largest_mantissa f / 2 = M - 1) as ->.
  { rewrite Largest. symmetry. apply Z.div_unique with 1; lia. }
  assert (Qceiling (sq (e + 1)) = M) as NextCeiling by (apply ceiling_is; lra).
  rewrite (quotient_found f (largest_exponent f) major other (e + 1) NotZero ltac:(lia)).
  - fold sq. rewrite NextCeiling. f_equal; [| lia]. symmetry.
    apply floor_is; rewrite inject_minus; change (inject_Z 1) with 1%Q; lra.
  - unfold fits. fold sq. rewrite NextCeiling. apply Z.leb_le. lia.
  - intros s Hs. destruct (Z.eq_dec s e) as [-> | Other]; [exact NotThis |]. apply Smaller. lia.
Qed.
