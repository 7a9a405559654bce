(* A ray's walk through a hierarchy with a trail, a short stack and restarts, as the machine `walker` takes it. For all
   trees and all lengths of the stack it ends, it tests the leaves that a walk tests which forgets nothing, and so it
   finds the least hit.

   The trail has a bit for each level of the path. 1: no child waits at this level. 0: the second child waits. A full
   stack drops its oldest child. If a child waits that the stack has dropped, the walk begins again at the root, and
   the trail leads it back. This is right because a hit lies in its boxes: so a child in which something was found is
   still accepted when the walk passes again, and no child becomes accepted that was not. *)
From Coq Require Import ZArith List Lia Bool.
Import ListNotations.
Open Scope Z_scope.

(* T and the number of its triangle. *)
Definition hit := (Z * Z)%type.
Definition less (a b : hit) : bool := (fst a <? fst b) || ((fst a =? fst b) && (snd a <? snd b)).

(* Of each child, where the ray enters and leaves its box. The child that is taken first is written first. Which one it
   is does not depend on the length of the ray. *)
Inductive tree :=
| Leaf (hits : list hit)
| Node (near0 far0 : Z) (t0 : tree) (near1 far1 : Z) (t1 : tree).

(* The machine. *)

Definition waiting := (Z * tree)%type.

Inductive state :=
(* At a record or a leaf. The trail's bits are those above, the deepest first, and those ahead, the highest first.
On the way back from the root the last of them is of the level at which a child waits. *)
| At (above ahead : list bool) (t : tree) (stack : list waiting) (best : hit)
(* Nothing is left below the trail's deepest level. *)
| Pop (trail : list bool) (stack : list waiting) (best : hit)
| Done (best : hit).

Definition push (places : nat) (child : waiting) (stack : list waiting) : list waiting :=
  firstn places (child :: stack).

Section Walk.

Variable root : tree.
Variable places : nat.

(* Which hits a ray wants: the nearest of all, those that are not before a place (next), or none that would make it
   shorter, so that it comes to each (count). *)
Variable wanted : hit -> bool.
Definition better (best h : hit) : hit := if wanted h && less h best then h else best.
Definition tested (hits : list hit) (best : hit) : hit := fold_left better hits best.

(* A T in units of the boxes' distances: rounded down. *)
Variable scaled : Z -> Z.
Hypothesis scaled_grows : forall a b, a <= b -> scaled a <= scaled b.
Definition reach (h : hit) : Z := scaled (fst h).

Definition accepts (near far : Z) (best : hit) : bool := (near <=? far) && (near <=? reach best).

Definition step (s : state) : state :=
  match s with
  | At above ahead (Leaf hits) stack best => Pop above stack (tested hits best)
  | At above ahead (Node near0 far0 t0 near1 far1 t1) stack best =>
      let bit := hd false ahead in
      let is_back := match ahead with [_] => true | _ => false end in
      let on t := if is_back then Pop (true :: above) stack best else At (true :: above) (tl ahead) t stack best in
      match accepts near0 far0 best, accepts near1 far1 best with
      | true, true =>
          if bit then At (true :: above) (tl ahead) t1 stack best
          else At (false :: above) (tl ahead) t0 (push places (near1, t1) stack) best
      | true, false => on t0
      | false, true => on t1
      | false, false => Pop (true :: above) stack best
      end
  | Pop [] stack best => Done best
  | Pop (true :: above) stack best => Pop above stack best
  | Pop (false :: above) [] best => At [] (rev (true :: above)) root [] best
  | Pop (false :: above) ((near, t) :: stack) best =>
      if reach best <? near then Pop (true :: above) stack best else At (true :: above) [] t stack best
  | Done best => Done best
  end.

(* With the leaves that were tested, in their order. *)
Definition tests_now (s : state) : list (list hit) :=
  match s with
  | At _ _ (Leaf hits) _ _ => [hits]
  | _ => []
  end.
Inductive runs : list (list hit) -> state -> state -> Prop :=
| Here s : runs [] s s
| Further s last leaves : runs leaves (step s) last -> runs (tests_now s ++ leaves) s last.

Lemma runs_on a b c first second : runs first a b -> runs second b c -> runs (first ++ second) a c.
Proof. induction 1; [trivial | intro; rewrite <- app_assoc; apply Further; auto]. Qed.
Lemma runs_to a b c leaves : runs leaves a b -> runs [] b c -> runs leaves a c.
Proof. intros First Rest. rewrite <- (app_nil_r leaves). now apply runs_on with b. Qed.
Lemma moves s last leaves : tests_now s = [] -> runs leaves (step s) last -> runs leaves s last.
Proof. intros None Rest. change leaves with ([] ++ leaves). rewrite <- None. now apply Further. Qed.

(* The walk that forgets nothing, as a function. *)
Fixpoint found (t : tree) (best : hit) : hit :=
  match t with
  | Leaf hits => tested hits best
  | Node near0 far0 t0 near1 far1 t1 =>
      let first := if accepts near0 far0 best then found t0 best else best in
      if accepts near1 far1 first then found t1 first else first
  end.

(* The leaves that it tests. *)
Fixpoint tests (t : tree) (best : hit) : list (list hit) :=
  match t with
  | Leaf hits => [hits]
  | Node near0 far0 t0 near1 far1 t1 =>
      let first := if accepts near0 far0 best then found t0 best else best in
      (if accepts near0 far0 best then tests t0 best else [])
        ++ (if accepts near1 far1 first then tests t1 first else [])
  end.

Fixpoint hits_of (t : tree) : list hit :=
  match t with
  | Leaf hits => hits
  | Node _ _ t0 _ _ t1 => hits_of t0 ++ hits_of t1
  end.

Definition within (near far : Z) (t : tree) : Prop := forall h, In h (hits_of t) -> near <= reach h <= far.
(* A hit lies in the boxes above it. *)
Fixpoint holds (t : tree) : Prop :=
  match t with
  | Leaf _ => True
  | Node near0 far0 t0 near1 far1 t1 => within near0 far0 t0 /\ within near1 far1 t1 /\ holds t0 /\ holds t1
  end.

Lemma better_is best h : better best h = best \/ better best h = h.
Proof. unfold better. destruct (wanted h && less h best); auto. Qed.

Lemma better_shrinks best h : fst (better best h) <= fst best.
Proof.
  unfold better, less. destruct (wanted h); [| cbn; lia]. destruct h as [t n], best as [u m]. cbn.
  destruct (Z.ltb_spec t u); cbn; [lia |]. destruct (Z.eqb_spec t u); cbn; [| lia].
  destruct (n <? m); cbn; lia.
Qed.

Lemma tested_from hits : forall best, tested hits best = best \/ In (tested hits best) hits.
Proof.
  induction hits as [| h hits Ind]; intro best; [now left |]. cbn.
  destruct (Ind (better best h)) as [Same | There]; [| now right; right].
  fold (tested hits (better best h)). rewrite Same.
  destruct (better_is best h) as [-> | ->]; [now left | now right; left].
Qed.

Lemma tested_shrinks hits : forall best, fst (tested hits best) <= fst best.
Proof.
  induction hits as [| h hits Ind]; intro best; [cbn; lia |]. cbn.
  specialize (Ind (better best h)). pose proof (better_shrinks best h). unfold tested in *. lia.
Qed.

Lemma found_from t : forall best, found t best = best \/ In (found t best) (hits_of t).
Proof.
  induction t as [hits | near0 far0 t0 Ind0 near1 far1 t1 Ind1]; intro best; [apply tested_from |].
  cbn. rewrite in_app_iff.
  destruct (accepts near0 far0 best).
  - destruct (accepts near1 far1 (found t0 best)).
    + destruct (Ind1 (found t0 best)) as [-> | There]; [| auto].
      destruct (Ind0 best) as [-> | There]; auto.
    + destruct (Ind0 best) as [-> | There]; auto.
  - destruct (accepts near1 far1 best); [| auto]. destruct (Ind1 best); auto.
Qed.

Lemma found_shrinks t : forall best, fst (found t best) <= fst best.
Proof.
  induction t as [hits | near0 far0 t0 Ind0 near1 far1 t1 Ind1]; intro best; [apply tested_shrinks |].
  cbn. destruct (accepts near0 far0 best).
  - pose proof (Ind0 best). destruct (accepts near1 far1 (found t0 best)); [| assumption].
    pose proof (Ind1 (found t0 best)). lia.
  - destruct (accepts near1 far1 best); [apply Ind1 | lia].
Qed.

Lemma reaches_less t best : reach (found t best) <= reach best.
Proof. apply scaled_grows, found_shrinks. Qed.

Lemma accepts_less near far a b : reach b <= reach a -> accepts near far a = false -> accepts near far b = false.
Proof.
  unfold accepts. intro Less. destruct (near <=? far); [cbn | reflexivity].
  destruct (Z.leb_spec near (reach a)); [discriminate |]. destruct (Z.leb_spec near (reach b)); [lia | reflexivity].
Qed.

Lemma accepts_is near far best : accepts near far best = true <-> near <= far /\ near <= reach best.
Proof. unfold accepts. rewrite andb_true_iff, !Z.leb_le. reflexivity. Qed.

(* The path from the root, the deepest first: which record, which child was taken, and the trail's bit. *)
Record frame := Frame {
  bit : bool; second : bool;
  near0 : Z; far0 : Z; t0 : tree;
  near1 : Z; far1 : Z; t1 : tree }.
Definition node (f : frame) : tree := Node (near0 f) (far0 f) (t0 f) (near1 f) (far1 f) (t1 f).
Definition child (f : frame) : tree := if second f then t1 f else t0 f.
Definition entered (f : frame) : Z := if second f then near1 f else near0 f.
Definition bits (frames : list frame) : list bool := map bit frames.

Fixpoint path (frames : list frame) (t : tree) : Prop :=
  match frames with
  | [] => t = root
  | f :: above => t = child f /\ path above (node f)
  end.

(* What the bit says, and that the child that was taken is still accepted. *)
Definition right (best : hit) (f : frame) : Prop :=
  (bit f = true /\ second f = true /\ accepts (near1 f) (far1 f) best = true) \/
  (bit f = true /\ second f = false /\ accepts (near0 f) (far0 f) best = true /\
    accepts (near1 f) (far1 f) best = false) \/
  (bit f = false /\ second f = false /\ accepts (near0 f) (far0 f) best = true /\ near1 f <= far1 f).
Definition all_right (frames : list frame) (best : hit) : Prop := Forall (right best) frames.

Lemma right_still best less_best f :
  right best f -> reach less_best <= reach best -> entered f <= reach less_best -> right less_best f.
Proof.
  unfold right, entered. intros Was Less Entered.
  destruct Was as [[B [S One]] | [[B [S [Zero One]]] | [B [S [Zero One]]]]]; rewrite S in Entered.
  - left. rewrite accepts_is in *. repeat split; tauto || lia.
  - right. left. pose proof (accepts_less _ _ _ _ Less One). rewrite accepts_is in *. repeat split; tauto || lia.
  - right. right. rewrite accepts_is in *. repeat split; tauto || lia.
Qed.

(* Children that wait, the deepest first. The stack has the first of them. *)
Fixpoint wait (frames : list frame) : list waiting :=
  match frames with
  | [] => []
  | f :: above => if bit f then wait above else (near1 f, t1 f) :: wait above
  end.
Definition has (stack : list waiting) (frames : list frame) : Prop := exists k, stack = firstn k (wait frames).

Lemma has_pushed child stack frames f :
  has stack frames -> bit f = false -> child = (near1 f, t1 f) -> has (push places child stack) (f :: frames).
Proof.
  intros [k ->] Bit ->. exists (Nat.min places (S k)). unfold push. cbn [wait]. rewrite Bit.
  rewrite <- firstn_firstn. reflexivity.
Qed.

(* The same path, where children that became too far wait no more. *)
Definition done (f : frame) : frame := Frame true (second f) (near0 f) (far0 f) (t0 f) (near1 f) (far1 f) (t1 f).
Definition later (best : hit) (f g : frame) : Prop :=
  g = f \/ (bit f = false /\ accepts (near1 f) (far1 f) best = false /\ g = done f).
Definition all_later (best : hit) : list frame -> list frame -> Prop := Forall2 (later best).

Lemma later_itself best frames : all_later best frames frames.
Proof. induction frames; constructor; [now left | assumption]. Qed.

Lemma later_on a b : reach b <= reach a ->
  forall x y z, all_later a x y -> all_later b y z -> all_later b x z.
Proof.
  intros Less x y z First. revert z. induction First as [| f g x y Later _ Ind]; intros z Second.
  - exact Second.
  - inversion Second as [| g' h y' z' Later' Rest]; subst. constructor; [| now apply Ind].
    destruct Later as [-> | [Bit [Far ->]]]; [exact Later' |].
    destruct Later' as [-> | [Bit' _]]; [| discriminate].
    right. repeat split; [assumption | now apply accepts_less with a].
Qed.

Lemma later_path best x y : all_later best x y -> forall t, path x t -> path y t.
Proof.
  induction 1 as [| f g x y Later _ Ind]; intros t Path; [exact Path |].
  destruct Path as [Child Path]. destruct Later as [-> | [_ [_ ->]]]; split; auto.
Qed.

Lemma later_right best x y : all_later best x y -> all_right x best -> all_right y best.
Proof.
  induction 1 as [| f g x y Later _ Ind]; intro Right; [constructor |].
  inversion Right as [| f' x' Of Rest]; subst. constructor; [| now apply Ind].
  destruct Later as [-> | [Bit [Far ->]]]; [exact Of |].
  unfold right in *. destruct Of as [[B _] | [[B _] | [_ [S [Zero _]]]]]; [congruence | congruence |].
  right. left. cbn. auto.
Qed.

(* No hit that can still be found below t is before a child on the path. *)
Definition inside (frames : list frame) (t : tree) : Prop :=
  Forall (fun f => forall h, In h (hits_of t) -> entered f <= reach h) frames.

Lemma inside_less frames t u : inside frames t -> incl (hits_of u) (hits_of t) -> inside frames u.
Proof. intros Inside Part. eapply Forall_impl; [| exact Inside]. cbn. auto. Qed.

Lemma later_inside best x y t : all_later best x y -> inside x t -> inside y t.
Proof.
  induction 1 as [| f g x y Later _ Ind]; intro Inside; [constructor |].
  inversion Inside as [| f' x' Of Rest]; subst. constructor; [| now apply Ind].
  destruct Later as [-> | [_ [_ ->]]]; exact Of.
Qed.

Lemma entered_before best f : right best f -> entered f <= reach best.
Proof.
  unfold right, entered.
  intros [[_ [-> One]] | [[_ [-> [Zero _]]] | [_ [-> [Zero _]]]]]; rewrite accepts_is in *; tauto.
Qed.

Lemma right_after frames t best :
  all_right frames best -> inside frames t -> all_right frames (found t best).
Proof.
  unfold all_right, inside. rewrite !Forall_forall. intros Right Inside f There.
  apply right_still with best; [auto | apply reaches_less |].
  destruct (found_from t best) as [-> | Hit]; [now apply entered_before, Right | now apply Inside].
Qed.

(* A walk that begins again comes back to where it was. *)
Lemma comes_back best : forall frames t tail, tail <> [] -> path frames t -> all_right frames best ->
  exists frames' stack,
    runs [] (At [] (rev (bits frames) ++ tail) root [] best) (At (bits frames') tail t stack best) /\
    all_later best frames frames' /\ has stack frames'.
Proof.
  induction frames as [| f above Ind]; intros t tail Tail Path Right.
  - cbn in Path. subst t. exists [], []. cbn. repeat split; [apply Here | constructor | now exists 0%nat].
  - destruct Path as [-> Path]. inversion Right as [| f' above' Of Rest]; subst.
    destruct (Ind (node f) (bit f :: tail)) as [frames [stack [Runs [Later Has]]]];
      [discriminate | assumption | assumption |].
    cbn [bits map rev]. rewrite <- app_assoc. cbn [app].
    destruct tail as [| b tail]; [congruence |].
    unfold right in Of. destruct Of as [[B [S One]] | [[B [S [Zero One]]] | [B [S [Zero Ahead]]]]];
      unfold child; rewrite S.
    + exists (f :: frames), stack. repeat split.
      * apply (runs_to _ _ _ _ Runs). apply moves; [reflexivity |]. cbn. rewrite One, B.
        destruct (accepts (near0 f) (far0 f) best); apply Here.
      * constructor; [now left | exact Later].
      * destruct Has as [k ->]. exists k. cbn. now rewrite B.
    + exists (f :: frames), stack. repeat split.
      * apply (runs_to _ _ _ _ Runs). apply moves; [reflexivity |]. cbn. rewrite Zero, One, B. apply Here.
      * constructor; [now left | exact Later].
      * destruct Has as [k ->]. exists k. cbn. now rewrite B.
    + destruct (accepts (near1 f) (far1 f) best) eqn:One.
      * exists (f :: frames), (push places (near1 f, t1 f) stack). repeat split.
        -- apply (runs_to _ _ _ _ Runs). apply moves; [reflexivity |]. cbn. rewrite Zero, One, B. apply Here.
        -- constructor; [now left | exact Later].
        -- now apply has_pushed.
      * exists (done f :: frames), stack. repeat split.
        -- apply (runs_to _ _ _ _ Runs). apply moves; [reflexivity |]. cbn. rewrite Zero, One. apply Here.
        -- constructor; [right; auto | exact Later].
        -- destruct Has as [k ->]. now exists k.
Qed.

(* The machine is the walk that forgets nothing, below any record. *)
Lemma visits : forall t frames stack best,
  holds t -> path frames t -> all_right frames best -> inside frames t -> has stack frames ->
  exists frames' stack',
    runs (tests t best) (At (bits frames) [] t stack best) (Pop (bits frames') stack' (found t best)) /\
    all_later (found t best) frames frames' /\ has stack' frames'.
Proof.
  induction t as [hits | n0 f0 u0 Ind0 n1 f1 u1 Ind1]; intros frames stack best Holds Path Right Inside Has.
  - exists frames, stack.
    repeat split; [exact (Further (At (bits frames) [] (Leaf hits) stack best) _ [] (Here _))
      | apply later_itself | exact Has].
  - destruct Holds as [In0 [In1 [Holds0 Holds1]]].
    assert (inside frames u0) as Inside0 by (eapply inside_less; [exact Inside | apply incl_appl, incl_refl]).
    assert (inside frames u1) as Inside1 by (eapply inside_less; [exact Inside | apply incl_appr, incl_refl]).
    (* The second child is visited, from above frames where nothing waits at this level. *)
    assert (forall frames stack best, path frames (Node n0 f0 u0 n1 f1 u1) -> all_right frames best ->
      inside frames u1 -> has stack frames -> accepts n1 f1 best = true ->
      exists frames' stack',
        runs (tests u1 best) (At (true :: bits frames) [] u1 stack best)
          (Pop (bits frames') stack' (found u1 best)) /\
        all_later (found u1 best) frames frames' /\ has stack' frames') as Second.
    { intros fs st b P R I H One.
      destruct (Ind1 (Frame true true n0 f0 u0 n1 f1 u1 :: fs) st b) as [fs' [st' [Runs [Later Has']]]].
      - assumption.
      - now split.
      - constructor; [now left | assumption].
      - constructor; [intros h There; apply (In1 h There) | assumption].
      - destruct H as [k ->]. now exists k.
      - inversion Later as [| f g x y Same Rest]; subst.
        destruct Same as [-> | [Bit _]]; [| discriminate].
        exists y, st'. repeat split.
        + apply (runs_to _ _ _ _ Runs). apply moves, Here. reflexivity.
        + assumption.
        + destruct Has' as [k ->]. now exists k. }
    cbn [found tests]. destruct (accepts n0 f0 best) eqn:Zero, (accepts n1 f1 best) eqn:One.
    + (* Both are accepted. *)
      set (f := Frame false false n0 f0 u0 n1 f1 u1).
      destruct (Ind0 (f :: frames) (push places (n1, u1) stack) best) as [fs [st [Runs [Later Has']]]].
      * assumption.
      * now split.
      * constructor; [| assumption]. right. right. repeat split; [assumption |]. now apply accepts_is in One.
      * constructor; [intros h There; apply (In0 h There) | assumption].
      * now apply has_pushed.
      * set (b := found u0 best) in *.
        assert (reach b <= reach best) as Less by apply reaches_less.
        assert (all_right frames b) as Right' by now apply right_after.
        inversion Later as [| f' g x above Of Rest]; subst.
        assert (runs (tests u0 best) (At (bits frames) [] (Node n0 f0 u0 n1 f1 u1) stack best)
                     (Pop (bits (g :: above)) st b)) as Down.
        { apply moves; [reflexivity |]. cbn. rewrite Zero, One. exact Runs. }
        assert (path above (Node n0 f0 u0 n1 f1 u1)) as PathA by now apply later_path with b frames.
        assert (all_right above b) as RightA by now apply later_right with frames.
        assert (inside above u1) as InsideA by now apply later_inside with b frames.
        destruct Of as [-> | [_ [Far ->]]].
        -- destruct Has' as [k ->]. cbn [wait bit f] in *. destruct k as [| k].
           ++ (* The stack has dropped it: the walk begins again. *)
              destruct (comes_back b above (Node n0 f0 u0 n1 f1 u1) [true]) as [fs' [st' [Back [Later' Has']]]];
                [discriminate | assumption | assumption |].
              assert (accepts n0 f0 b = true) as Still.
              { apply accepts_is in Zero. apply accepts_is. split; [tauto |]. unfold b.
                destruct (found_from u0 best) as [-> | Hit]; [tauto | apply (In0 _ Hit)]. }
              assert (runs (tests u0 best) (At (bits frames) [] (Node n0 f0 u0 n1 f1 u1) stack best)
                           (At (bits fs') [true] (Node n0 f0 u0 n1 f1 u1) st' b)) as Again.
              { apply (runs_to _ _ _ _ Down). apply moves; [reflexivity |]. exact Back. }
              destruct (accepts n1 f1 b) eqn:OneB.
              ** destruct (Second fs' st' b) as [fs2 [st2 [Runs2 [Later2 Has2]]]];
                   [now apply later_path with b above | now apply later_right with above |
                    now apply later_inside with b above | assumption | assumption |].
                 exists fs2, st2. repeat split; [| | assumption].
                 --- apply (runs_on _ _ _ _ _ Again). apply moves; [reflexivity |]. cbn. rewrite Still, OneB.
                     exact Runs2.
                 --- apply later_on with b fs'; [apply reaches_less | | assumption].
                     apply later_on with b above; [lia | assumption | assumption].
              ** exists fs', st'. repeat split; [| | assumption].
                 --- apply (runs_on _ _ _ _ _ Again). apply moves; [reflexivity |]. cbn. rewrite Still, OneB.
                     apply moves, Here. reflexivity.
                 --- apply later_on with b above; [lia | assumption | assumption].
           ++ (* The stack has it. *)
              cbn [firstn] in Down. destruct (reach b <? n1) eqn:TooFar.
              ** assert (accepts n1 f1 b = false) as ->.
                 { unfold accepts. apply Z.ltb_lt in TooFar.
                   destruct (Z.leb_spec n1 (reach b)); [lia | apply andb_false_r]. }
                 exists above, (firstn k (wait above)). repeat split; [| assumption | now exists k].
                 apply (runs_on _ _ _ _ _ Down). apply moves; [reflexivity |]. cbn. rewrite TooFar.
                 apply moves, Here. reflexivity.
              ** assert (accepts n1 f1 b = true) as OneB.
                 { apply accepts_is in One. apply accepts_is. apply Z.ltb_ge in TooFar. tauto. }
                 rewrite OneB.
                 destruct (Second above (firstn k (wait above)) b) as [fs2 [st2 [Runs2 [Later2 Has2]]]];
                   [assumption | assumption | assumption | now exists k | assumption |].
                 exists fs2, st2. repeat split; [| | assumption].
                 --- apply (runs_on _ _ _ _ _ Down). apply moves; [reflexivity |]. cbn. rewrite TooFar. exact Runs2.
                 --- apply later_on with b above; [apply reaches_less | assumption | assumption].
        -- (* It became too far, and the walk has begun again below. *)
           cbn [near1 far1 f] in Far. rewrite Far.
           exists above, st. repeat split; [| assumption |].
           ++ apply (runs_on _ _ _ _ _ Down). apply moves, Here. reflexivity.
           ++ destruct Has' as [k ->]. now exists k.
    + (* The first alone. *)
      destruct (Ind0 (Frame true false n0 f0 u0 n1 f1 u1 :: frames) stack best) as [fs [st [Runs [Later Has']]]].
      * assumption.
      * now split.
      * constructor; [| assumption]. right. left. now repeat split.
      * constructor; [intros h There; apply (In0 h There) | assumption].
      * destruct Has as [k ->]. now exists k.
      * rewrite (accepts_less n1 f1 best (found u0 best)) by (apply reaches_less || assumption).
        inversion Later as [| f g x above Same Rest]; subst.
        destruct Same as [-> | [Bit _]]; [| discriminate].
        exists above, st. repeat split; [| assumption |].
        -- apply moves; [reflexivity |]. cbn. rewrite Zero, One. apply (runs_on _ _ _ _ _ Runs).
           apply moves, Here. reflexivity.
        -- destruct Has' as [k ->]. now exists k.
    + (* The second alone. *)
      destruct (Second frames stack best) as [fs [st [Runs [Later Has']]]]; try assumption.
      exists fs, st. repeat split; [| assumption | assumption].
      apply moves; [reflexivity |]. cbn. rewrite Zero, One. exact Runs.
    + exists frames, stack. repeat split; [| apply later_itself | assumption].
      apply moves; [reflexivity |]. cbn. rewrite Zero, One. apply moves, Here. reflexivity.
Qed.

(* The walk ends, whatever the length of its stack, and tests the leaves of the walk that forgets nothing. *)
Theorem walk_forgets_nothing best :
  holds root -> runs (tests root best) (At [] [] root [] best) (Done (found root best)).
Proof.
  intro Holds.
  destruct (visits root [] [] best) as [frames [stack [Runs [Later _]]]];
    [assumption | reflexivity | constructor | constructor | now exists 0%nat |].
  inversion Later; subst. apply (runs_to _ _ _ _ Runs). apply moves, Here. reflexivity.
Qed.

(* What it ends with is the least hit, or `best` if there is none less. *)

Lemma less_not a b c : less a b = false -> less b c = false -> less a c = false.
Proof.
  destruct a as [t n], b as [u m], c as [v o]. unfold less. cbn.
  destruct (Z.ltb_spec t u), (Z.eqb_spec t u), (Z.ltb_spec n m), (Z.ltb_spec u v), (Z.eqb_spec u v),
    (Z.ltb_spec m o),
    (Z.ltb_spec t v), (Z.eqb_spec t v), (Z.ltb_spec n o); cbn; try discriminate; try lia; reflexivity.
Qed.

Lemma less_itself h : less h h = false.
Proof. destruct h as [t n]. unfold less. cbn. now rewrite Z.ltb_irrefl, Z.eqb_refl, Z.ltb_irrefl. Qed.

Lemma better_least best h :
  (wanted h = true -> less h (better best h) = false) /\ less best (better best h) = false.
Proof.
  unfold better. destruct (wanted h); [cbn | split; [discriminate | apply less_itself]].
  destruct (less h best) eqn:Less; split; try (intros _; assumption).
  - intros _. apply less_itself.
  - destruct h as [t n], best as [u m]. unfold less in *. cbn in *.
    destruct (Z.ltb_spec t u), (Z.eqb_spec t u), (Z.ltb_spec n m), (Z.ltb_spec u t), (Z.eqb_spec u t),
      (Z.ltb_spec m n);
      cbn in *; try discriminate; try lia; reflexivity.
  - apply less_itself.
Qed.

Definition is_least (hits : list hit) (best least : hit) : Prop :=
  less best least = false /\ forall h, In h hits -> wanted h = true -> less h least = false.

Lemma tested_least hits : forall best, is_least hits best (tested hits best).
Proof.
  induction hits as [| h hits Ind]; intro best; cbn.
  - split; [apply less_itself | contradiction].
  - destruct (Ind (better best h)) as [Best Hits]. destruct (better_least best h) as [OfH OfBest]. split.
    + now apply less_not with (better best h).
    + intros g [<- | There] Wanted; [apply less_not with (better best h); auto | now apply Hits].
Qed.

(* Nothing is lost with a child that is not accepted. *)
Lemma refused_is_farther near far t best h :
  within near far t -> accepts near far best = false -> In h (hits_of t) -> less h best = false.
Proof.
  intros Within Refused There. specialize (Within h There). unfold accepts in Refused.
  destruct (Z.leb_spec near far); [cbn in Refused | lia]. apply Z.leb_gt in Refused.
  assert (fst best < fst h) by (destruct (Z.le_gt_cases (fst h) (fst best)) as [Near | Far];
    [apply scaled_grows in Near; unfold reach in *; lia | assumption]).
  unfold less. destruct (Z.ltb_spec (fst h) (fst best)); [lia |].
  destruct (Z.eqb_spec (fst h) (fst best)); [lia | reflexivity].
Qed.

Theorem found_is_least t : holds t -> forall best, is_least (hits_of t) best (found t best).
Proof.
  induction t as [hits | near0 far0 t0 Ind0 near1 far1 t1 Ind1]; intros Holds best; [apply tested_least |].
  destruct Holds as [In0 [In1 [Holds0 Holds1]]]. cbn.
  set (first := if accepts near0 far0 best then found t0 best else best).
  assert (is_least (hits_of t0) best first) as [Best0 Hits0].
  { unfold first. destruct (accepts near0 far0 best) eqn:Zero; [now apply Ind0 |]. split.
    - apply less_itself.
    - intros h There _. now apply refused_is_farther with near0 far0 t0. }
  assert (is_least (hits_of t1) first (if accepts near1 far1 first then found t1 first else first))
    as [Best1 Hits1].
  { destruct (accepts near1 far1 first) eqn:One; [now apply Ind1 |]. split.
    - apply less_itself.
    - intros h There _. now apply refused_is_farther with near1 far1 t1. }
  split; [now apply less_not with first |].
  intros h There Wanted. apply in_app_iff in There. destruct There; [apply less_not with first; auto | auto].
Qed.

Lemma found_is_wanted t : forall best, found t best = best \/ wanted (found t best) = true.
Proof.
  assert (forall hits best, tested hits best = best \/ wanted (tested hits best) = true) as OfLeaf.
  { induction hits as [| h hits Ind]; intro best; [now left |]. cbn.
    destruct (Ind (better best h)) as [Same | Wanted]; [| now right].
    fold (tested hits (better best h)). rewrite Same. unfold better.
    destruct (wanted h) eqn:Wanted; cbn; [| now left]. destruct (less h best); [now right | now left]. }
  induction t as [hits | near0 far0 t0 Ind0 near1 far1 t1 Ind1]; intro best; [apply OfLeaf |]. cbn.
  assert ((if accepts near0 far0 best then found t0 best else best) = best \/
    wanted (if accepts near0 far0 best then found t0 best else best) = true) as First
    by (destruct (accepts near0 far0 best); auto).
  destruct (accepts near1 far1 _); [| exact First].
  destruct (Ind1 (if accepts near0 far0 best then found t0 best else best)) as [-> | Wanted]; auto.
Qed.

Theorem walk_finds_the_least best :
  holds root -> exists least,
    runs (tests root best) (At [] [] root [] best) (Done least) /\
    is_least (hits_of root) best least /\ (least = best \/ In least (hits_of root) /\ wanted least = true).
Proof.
  intro Holds. exists (found root best).
  split; [now apply walk_forgets_nothing | split; [now apply found_is_least |]].
  destruct (found_from root best), (found_is_wanted root best); auto.
Qed.

(* A walk for any hit ends at the first leaf that has one. *)
Definition meets (hits : list hit) (best : hit) : bool := existsb (fun h => wanted h && less h best) hits.
Definition step_any (s : state) : state :=
  match s with
  | At _ _ (Leaf hits) _ best => if meets hits best then Done (tested hits best) else step s
  | _ => step s
  end.
Inductive runs_any : state -> state -> Prop :=
| AnyHere s : runs_any s s
| AnyFurther s last : runs_any (step_any s) last -> runs_any s last.

Definition best_of (s : state) : hit :=
  match s with
  | At _ _ _ _ best | Pop _ _ best | Done best => best
  end.

Lemma less_on a b c : less a b = true -> less b c = true -> less a c = true.
Proof.
  destruct a as [t n], b as [u m], c as [v o]. unfold less. cbn.
  rewrite !orb_true_iff, !andb_true_iff, !Z.ltb_lt, !Z.eqb_eq. lia.
Qed.

Lemma meets_nothing hits best : meets hits best = false -> tested hits best = best.
Proof.
  unfold meets. induction hits as [| h hits Ind]; [reflexivity |]. cbn. rewrite orb_false_iff. intros [Not Rest].
  unfold better at 2. rewrite Not. now apply Ind.
Qed.

Lemma meets_less hits best : meets hits best = true -> less (tested hits best) best = true.
Proof.
  unfold meets. rewrite existsb_exists. intros [h [There Less]].
  apply andb_true_iff in Less. destruct Less as [Wanted Less].
  destruct (tested_least hits best) as [_ Least]. specialize (Least h There Wanted).
  destruct (less (tested hits best) best) eqn:Now; [reflexivity |].
  rewrite (less_not _ _ _ Least Now) in Less. discriminate.
Qed.

Lemma step_keeps s : tests_now s = [] -> step_any s = step s /\ best_of (step s) = best_of s.
Proof.
  destruct s as [above ahead [hits | n0 f0 u0 n1 f1 u1] stack best | [| [] trail] [| [near t] stack] best | best];
    try discriminate; intros _; cbn; split; try reflexivity.
  - destruct ahead as [| a [| b ahead]]; cbn; destruct (accepts n0 f0 best), (accepts n1 f1 best); try reflexivity;
      destruct a; reflexivity.
  - destruct (reach best <? near); reflexivity.
Qed.

Lemma any_as_nearest leaves s last : runs leaves s last -> forall least, last = Done least ->
  exists some, runs_any s (Done some) /\
    ((some = best_of s /\ least = best_of s) \/ (less some (best_of s) = true /\ less least (best_of s) = true)).
Proof.
  induction 1 as [s | s last leaves _ Ind]; intros least Is.
  - subst. exists least. split; [apply AnyHere | now left].
  - destruct (Ind least Is) as [some [Runs Same]].
    destruct s as [above ahead [hits | n0 f0 u0 n1 f1 u1] stack best | trail stack best | best].
    + destruct (meets hits best) eqn:Meets.
      * exists (tested hits best). split; [apply AnyFurther; cbn; rewrite Meets; apply AnyHere |].
        right. pose proof (meets_less _ _ Meets) as Less. cbn in *. split; [assumption |].
        destruct Same as [[_ ->] | [_ Further]]; [assumption | now apply less_on with (tested hits best)].
      * exists some. split; [apply AnyFurther; cbn [step_any]; rewrite Meets; assumption |].
        cbn in *. now rewrite (meets_nothing _ _ Meets) in Same.
    + destruct (step_keeps (At above ahead (Node n0 f0 u0 n1 f1 u1) stack best) eq_refl) as [Any Best].
      exists some. split; [apply AnyFurther; rewrite Any; assumption | now rewrite Best in Same].
    + destruct (step_keeps (Pop trail stack best) eq_refl) as [Any Best].
      exists some. split; [apply AnyFurther; rewrite Any; assumption | now rewrite Best in Same].
    + exists some. split; [apply AnyFurther; assumption | assumption].
Qed.

(* It ends, with a hit exactly if there is one. *)
Theorem any_hit_is_found best : holds root -> exists some,
  runs_any (At [] [] root [] best) (Done some) /\
  (some = best /\ (forall h, In h (hits_of root) -> wanted h = true -> less h best = false) \/
   less some best = true).
Proof.
  intro Holds.
  destruct (any_as_nearest _ _ _ (walk_forgets_nothing best Holds) _ eq_refl) as [some [Runs Same]].
  exists some. split; [assumption |]. cbn in Same. destruct Same as [[Some None] | [Less _]]; [left | now right].
  split; [assumption |]. destruct (found_is_least root Holds best) as [_ Least]. now rewrite None in Least.
Qed.

(* Each leaf is tested once, in its turn: what is tested is the leaves of the tree with some left out. *)
Fixpoint leaves (t : tree) : list (list hit) :=
  match t with
  | Leaf hits => [hits]
  | Node _ _ t0 _ _ t1 => leaves t0 ++ leaves t1
  end.
Inductive some_of {A} : list A -> list A -> Prop :=
| Nothing : some_of [] []
| Kept a x y : some_of x y -> some_of (a :: x) (a :: y)
| Left a x y : some_of x y -> some_of x (a :: y).

Lemma none_of {A} (y : list A) : some_of [] y.
Proof. induction y; [apply Nothing | now apply Left]. Qed.
Lemma some_of_both {A} (x y u v : list A) : some_of x y -> some_of u v -> some_of (x ++ u) (y ++ v).
Proof. intros First Second. induction First; cbn; [assumption | now apply Kept | now apply Left]. Qed.

Theorem each_leaf_once t : forall best, some_of (tests t best) (leaves t).
Proof.
  induction t as [hits | near0 far0 t0 Ind0 near1 far1 t1 Ind1]; intro best; [apply Kept, Nothing |].
  cbn. apply some_of_both.
  - destruct (accepts near0 far0 best); [apply Ind0 | apply none_of].
  - destruct (accepts near1 far1 _); [apply Ind1 | apply none_of].
Qed.

(* No leaf is left out that the best hit at the end does not exclude. Of a ray that wants none, that is each leaf with a
   hit within its length: so what is counted in the leaves that are tested are all hits. *)
Theorem each_hit_is_met t h : holds t -> In h (hits_of t) ->
  forall best, reach h <= reach (found t best) -> exists leaf, In leaf (tests t best) /\ In h leaf.
Proof.
  induction t as [hits | near0 far0 t0 Ind0 near1 far1 t1 Ind1]; intros Holds There best Near.
  - exists hits. split; [now left | exact There].
  - destruct Holds as [In0 [In1 [Holds0 Holds1]]]. cbn in *.
    set (first := if accepts near0 far0 best then found t0 best else best) in *.
    assert (reach (if accepts near1 far1 first then found t1 first else first) <= reach first) as Last.
    { destruct (accepts near1 far1 first); [apply reaches_less | lia]. }
    apply in_app_iff in There. destruct There as [There | There].
    + destruct (accepts near0 far0 best) eqn:Zero.
      * destruct (Ind0 Holds0 There best) as [leaf [Tested Is]]; [subst first; lia |].
        exists leaf. split; [apply in_or_app; now left | exact Is].
      * exfalso. specialize (In0 h There). subst first.
        assert (accepts near0 far0 best = true) as Yes by (apply accepts_is; lia). congruence.
    + destruct (accepts near1 far1 first) eqn:One.
      * destruct (Ind1 Holds1 There first) as [leaf [Tested Is]]; [lia |].
        exists leaf. split; [apply in_or_app; now right | exact Is].
      * exfalso. specialize (In1 h There).
        assert (accepts near1 far1 first = true) as Yes by (apply accepts_is; lia). congruence.
Qed.

Lemma wants_none t : (forall h, wanted h = false) -> forall best, found t best = best.
Proof.
  intros None. assert (forall hits best, tested hits best = best) as Same.
  { induction hits as [| h hits Ind]; intro best; [reflexivity |]. cbn. unfold better at 2. rewrite None. apply Ind. }
  induction t as [hits | near0 far0 t0 Ind0 near1 far1 t1 Ind1]; intro best; [apply Same |].
  cbn. rewrite Ind0. destruct (accepts near0 far0 best), (accepts near1 far1 best); auto.
Qed.

Theorem count_meets_each_hit h best :
  holds root -> (forall g, wanted g = false) -> In h (hits_of root) -> reach h <= reach best ->
  exists leaf, In leaf (tests root best) /\ In h leaf.
Proof. intros Holds None There Near. apply each_hit_is_met; [assumption | assumption |]. now rewrite wants_none. Qed.

End Walk.
