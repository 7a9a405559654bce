// Writes lemmas as SMT-LIB for z3: emit_lemmas trimming | products | pieces | shifts | saturation | bound |
// attained N.
// Before each answer the script says what it is about and which answer proves the lemma: "sat" if it says
// that a value is attained.
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string>

#include <fmt/format.h>

#include "hls/box/int_format.hpp"
#include "hls/box/major_format.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "rtl_gen/component/library.hpp"

namespace {

using namespace hitpipe;

void check(const std::string& what, const std::string& expected, const std::string& body,
           const std::string& command = "(check-sat)") {
  fmt::print("(push)\n{}(echo \"{} : {}\")\n{}\n(pop)\n", body, what, expected, command);
}

std::string between(const std::string& least, const std::string& value, const std::string& most) {
  return fmt::format("(assert (<= {} {} {}))\n", least, value, most);
}

std::string integer(std::int64_t value) {
  return value < 0 ? fmt::format("(- {})", -value) : std::to_string(value);
}

/// Dropping low bits keeps the order and the sign; the bits that a format keeps are the shifted product.
void trimming() {
  fmt::print(
      "(declare-const x (_ BitVec 64))\n(declare-const y (_ BitVec 64))\n(declare-const k (_ BitVec 64))\n");
  check("order, any k", "unsat",
        "(assert (bvsle x y))\n(assert (bvult k #x0000000000000040))\n"
        "(assert (not (bvsle (bvashr x k) (bvashr y k))))\n");
  check("sign, any k", "unsat",
        "(assert (bvult k #x0000000000000040))\n(assert (not (= (bvslt x #x0000000000000000) "
        "(bvslt (bvashr x k) #x0000000000000000))))\n");
  for (int n = hls::IntBits::min_coord; n <= hls::IntBits::max_coord; ++n) {
    std::string wrong;
    for (int t = hls::IntBits::min_interval; t <= 2 * n - 1; ++t) {
      const int k = 2 * n - 1 - t;
      wrong += fmt::format(
          "(distinct ((_ sign_extend {}) ((_ extract {} {}) x)) (bvashr ((_ sign_extend {}) ((_ extract {} "
          "0) x)) "
          "(_ bv{} 64)))\n",
          64 - t, 2 * n - 2, k, 65 - 2 * n, 2 * n - 2, k);
    }
    check(fmt::format("kept bits, n = {}, t = 6..{}", n, 2 * n - 1), "unsat",
          fmt::format("(assert (or false {}))\n", wrong));
  }
}

/// A difference times an IRDVC or direction, both within +-(2^(n-1)-1), is a signed word of 2n-1 bits.
void products() {
  fmt::print("(declare-const a Int)\n(declare-const b Int)\n");
  for (int n = hls::IntBits::min_coord; n <= hls::IntBits::max_coord; ++n) {
    const std::int64_t most = (std::int64_t{1} << (n - 1)) - 1;
    const std::int64_t beyond = std::int64_t{1} << (2 * n - 2);
    check(
        fmt::format("product bits, n = {}", n), "unsat",
        between(integer(-most), "a", integer(most)) + between(integer(-most), "b", integer(most)) +
            fmt::format("(assert (or (>= (* a b) {}) (< (* a b) {})))\n", integer(beyond), integer(-beyond)));
  }
}

/// What multiplier proofs assume about multiplication (component.cpp), for integers: the product is the sum
/// of the products of the pieces, and the product of a piece fits the bits of its operands.
void pieces() {
  fmt::print("(declare-const a Int)\n(declare-const b Int)\n");
  for (int i = 0; i < 4; ++i) fmt::print("(declare-const p{} Int)\n", i);
  for (int n = hls::IntBits::min_coord; n <= hls::IntBits::max_coord; ++n) {
    const int stages = rtl::Library::thesis().timing(rtl::Component::int_multiply, n).stages;
    const int piece = (n + stages - 1) / stages;
    std::string sum_b = "0";
    std::string sum = "0";
    std::string wrong;
    std::string ranges =
        between(integer(-(std::int64_t{1} << (n - 1))), "a", integer((std::int64_t{1} << (n - 1)) - 1));
    for (int low = 0, i = 0; low < n; low += piece, ++i) {
      const bool top = low + piece >= n;
      const int width = top ? n - low : piece;
      const std::int64_t span = std::int64_t{1} << (top ? width - 1 : width);
      ranges += between(top ? integer(-span) : "0", fmt::format("p{}", i), integer(span - 1));
      sum_b += fmt::format(" (* {} p{})", std::int64_t{1} << low, i);
      sum += fmt::format(" (* {} (* a p{}))", std::int64_t{1} << low, i);
      // The top piece has its own sign bit, the others a zero bit above them.
      const std::int64_t limit = std::int64_t{1} << (n + width + (top ? 0 : 1) - 1);
      wrong += fmt::format(" (>= (* a p{0}) {1}) (< (* a p{0}) {2})", i, integer(limit), integer(-limit));
    }
    check(fmt::format("sum of pieces, n = {}, {} stages", n, stages), "unsat",
          fmt::format("(assert (= b (+ {})))\n(assert (not (= (* a b) (+ {}))))\n", sum_b, sum));
    check(fmt::format("range of pieces, n = {}", n), "unsat",
          ranges + fmt::format("(assert (or{}))\n", wrong));
  }
}

/// What the proofs of fitted designs assume about a product (emit_fitted.cpp), for integers: without the
/// zeros at the end of an operand, the product is shifted down by that many bits.
void shifts() {
  for (const char* name : {"a", "b", "c"}) fmt::print("(declare-const {} Int)\n", name);
  for (int k = 1; k < 64; ++k) {
    const std::uint64_t unit = std::uint64_t{1} << k;
    check(fmt::format("a * b, a = c << {}", k), "unsat",
          fmt::format("(assert (= a (* {0} c)))\n(assert (distinct (* a b) (* {0} (* c b))))\n", unit));
  }
}

/// The saturating shift of a word of `width` bits (hls/num/saturating_shift.hpp), as its levels compute it
/// and as what it means: x 2^e in twice the width, cut to the word's range.
void saturating_shift(int width) {
  const int levels = hls::count_bits(width);
  const int bits = width - 1;
  const int wide = 2 * width;
  fmt::print("(push)\n(declare-const x (_ BitVec {}))\n(declare-const e (_ BitVec {}))\n", width, levels);
  fmt::print("(assert (bvule e (_ bv{} {})))\n", width - 1, levels);
  fmt::print("(define-fun fill () (_ BitVec {0}) ((_ repeat {0}) ((_ extract {0} {0}) x)))\n", bits);
  fmt::print("(define-fun m{} () (_ BitVec {}) (bvxor ((_ extract {} 0) x) fill))\n", levels, bits, bits - 1);
  std::string lost = "(= #b0 #b1)";
  for (int power = levels - 1; power >= 0; --power) {
    const int amount = std::min(1 << power, bits);
    const std::string from = fmt::format("m{}", power + 1);
    const std::string moved = amount == bits
                                  ? "fill"
                                  : fmt::format("(concat ((_ extract {} 0) {}) ((_ extract {} 0) fill))",
                                                bits - 1 - amount, from, amount - 1);
    const std::string shift = fmt::format("(= ((_ extract {0} {0}) e) #b1)", power);
    lost = fmt::format("(or {} (and {} (distinct ((_ extract {} {}) {}) (_ bv0 {}))))", lost, shift, bits - 1,
                       bits - amount, from, amount);
    fmt::print("(define-fun m{} () (_ BitVec {}) (ite {} {} {}))\n", power, bits, shift, moved, from);
  }
  fmt::print(
      "(define-fun levels () (_ BitVec {0}) (concat ((_ extract {1} {1}) x) (bvxor fill (ite {2} (bvnot (_ "
      "bv0 {1})) m0))))\n",
      width, bits, lost);
  fmt::print(
      "(define-fun whole () (_ BitVec {0}) (bvshl ((_ sign_extend {1}) x) ((_ zero_extend {2}) e)))\n"
      "(define-fun most () (_ BitVec {0}) ((_ zero_extend {3}) (bvnot (_ bv0 {4}))))\n",
      wide, width, wide - levels, wide - bits, bits);
  check(fmt::format("levels = x 2^e, cut to the word, {} bits", width), "unsat",
        fmt::format("(assert (distinct ((_ sign_extend {}) levels) (ite (bvsgt whole most) most (ite (bvslt "
                    "whole (bvnot most)) (bvnot most) whole))))\n",
                    width));
  fmt::print("(pop)\n");
}

/// The shift for every width of a difference, and the product of what it gives and a mantissa: its bits, and
/// that saturation errs outward.
void saturation() {
  using hls::MajorBits;
  for (int width = MajorBits::min_coord; width <= MajorBits::max_coord + MajorBits::max_finer; ++width)
    saturating_shift(width);
  fmt::print("(declare-const s Int)\n(declare-const m Int)\n(declare-const whole Int)\n");
  for (int width = MajorBits::min_coord; width <= MajorBits::max_coord + MajorBits::max_finer; ++width) {
    const std::int64_t most = (std::int64_t{1} << (width - 1)) - 1;
    std::string wrong;
    for (int p = MajorBits::min_mantissa; p <= MajorBits::max_mantissa && width + p <= MajorBits::max_product;
         ++p)
      wrong += fmt::format(" (and (<= m {0}) (or (>= (* s m) {1}) (< (* s m) (- {1}))))",
                           (std::int64_t{1} << p) - 1, std::int64_t{1} << (width + p - 1));
    check(fmt::format("product bits, n + g = {}", width), "unsat",
          between(integer(-most - 1), "s", integer(most)) + "(assert (>= m 0))\n" +
              fmt::format("(assert (or false{}))\n", wrong));
  }
  check("a near distance that saturates above is not larger", "unsat",
        "(assert (>= m 0))\n(assert (<= s whole))\n(assert (> (* s m) (* whole m)))\n");
  check("what saturates below stays negative", "unsat",
        "(assert (>= m 1))\n(assert (< s 0))\n(assert (>= (* s m) 0))\n");
  check("a far distance that saturates above is at least the largest shift", "unsat",
        "(declare-const unit Int)\n(assert (>= unit 1))\n(assert (>= m unit))\n(assert (>= s 0))\n"
        "(assert (< (* s m) (* s unit)))\n");
}

/// An s in [0, 1] with s * a <= b: of all s the constraint leaves an interval, here as fractions.
std::string reaches() {
  return "(define-fun alone ((a W) (b W)) Bool (ite (bvslt a zero) (bvsge b a) (bvsge b zero)))\n"
         "(define-fun both ((a W) (b W) (c W) (d W)) Bool\n"
         "  (=> (and (bvsgt a zero) (bvslt c zero)) (bvsle (bvmul (bvneg d) a) (bvmul b (bvneg c)))))\n"
         "(define-fun reaches ((a W) (b W) (c W) (d W)) Bool\n"
         "  (and (alone a b) (alone c d) (both a b c d) (both c d a b)))\n";
}

/// The least side relation of an edge when a ray passes on its inner side (int_plucker_ray.cpp). It covers
/// all directions e within half a unit of (di, dj) and M of zero, and all planes i, j within M. Twice e and
/// twice the planes are integers. This also covers all real e between, because only the ends count.
void attained(int n) {
  const int width = 2 * n + 3;
  const std::int64_t most = (std::int64_t{1} << (n - 1)) - 1;
  const auto word = [&](std::int64_t value) {
    return fmt::format("(_ bv{} {})", static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << width) - 1),
                       width);
  };
  fmt::print("(define-sort W () (_ BitVec {}))\n(define-fun zero () W {})\n{}", width, word(0), reaches());
  for (const char* name : {"di", "dj", "i", "j"}) {
    fmt::print(
        "(declare-const {0}_bits (_ BitVec {1}))\n(define-fun {0} () W ((_ sign_extend {2}) {0}_bits))\n"
        "(assert (bvsge {0} {3}))\n",
        name, n, width - n, word(-most));
  }
  fmt::print(
      "(define-fun least ((d W)) W (ite (= d {0}) {1} (bvsub (bvadd d d) {2})))\n"
      "(define-fun most ((d W)) W (ite (= d {3}) {4} (bvadd (bvadd d d) {2})))\n",
      word(-most), word(-2 * most), word(1), word(most), word(2 * most));
  fmt::print(
      "(assert (reaches\n"
      "  (ite (bvsge dj zero) (least di) (bvneg (most di))) (bvmul {0} (ite (bvsge dj zero) i (bvneg i)))\n"
      "  (ite (bvsge di zero) (bvneg (most dj)) (least dj)) (bvmul {0} (ite (bvsge di zero) (bvneg j) "
      "j))))\n",
      word(2));
  for (int k = 0; k <= 2 * n - 3; ++k) {
    const std::int64_t unit = std::int64_t{1} << k;
    const std::int64_t attained = -((most - 1 + unit - 1) / unit);
    if (hls::int_plucker::edge_bound({n, 2 * n - 1 - k}) != attained)
      throw std::runtime_error("EBND is not the bound");
    const std::string side =
        fmt::format("(bvsub (bvashr (bvmul dj i) {0}) (bvashr (bvmul di j) {0}))", word(k));
    check(fmt::format("side < {}, n = {}, k = {}", attained, n, k), "unsat",
          fmt::format("(assert (bvslt {} {}))\n", side, word(attained)), "(check-sat-using qfbv)");
    check(fmt::format("side = {}, n = {}, k = {}", attained, n, k), "sat",
          fmt::format("(assert (= {} {}))\n", side, word(attained)), "(check-sat-using qfbv)");
  }
}

/// EBND for every format, by the argument of int_plucker_ray.cpp: xi = s ei and xj = s ej lie inside the
/// planes I, J; di and dj are within half a unit of ei, ej; M is the largest component.
void bound() {
  for (const char* name : {"M", "s", "ei", "ej", "di", "dj", "I", "J", "xi", "xj", "u", "a", "b"})
    fmt::print("(declare-const {} Real)\n", name);
  fmt::print("(define-fun size ((x Real)) Real (ite (< x 0.0) (- x) x))\n");
  check("q - p >= dj xi - di xj", "unsat",
        "(assert (ite (>= dj 0.0) (<= xi I) (>= xi I)))\n(assert (ite (>= di 0.0) (>= xj J) (<= xj J)))\n"
        "(assert (< (- (* dj I) (* di J)) (- (* dj xi) (* di xj))))\n");
  check("dj xi - di xj = (dj - ej) xi - (di - ei) xj", "unsat",
        "(assert (= xi (* s ei)))\n(assert (= xj (* s ej)))\n"
        "(assert (not (= (- (* dj xi) (* di xj)) (- (* (- dj ej) xi) (* (- di ei) xj)))))\n");
  check("|u| <= 1/2: u x >= -|x| / 2", "unsat",
        "(assert (<= (size u) 0.5))\n(assert (< (* u xi) (- (/ (size xi) 2.0))))\n");
  check(
      "equality needs |u| = 1/2 or x = 0", "unsat",
      "(assert (< (size u) 0.5))\n(assert (distinct xi 0.0))\n(assert (= (* u xi) (- (/ (size xi) 2.0))))\n");
  check("their sum >= -M, and more unless |xi| = |xj| = M and both are least", "unsat",
        "(assert (> M 0.0))\n(assert (<= (size xi) M))\n(assert (<= (size xj) M))\n"
        "(assert (>= a (- (/ (size xi) 2.0))))\n(assert (>= b (- (/ (size xj) 2.0))))\n(assert (<= (+ a b) "
        "(- M)))\n"
        "(assert (not (and (= (size xi) M) (= (size xj) M) (= a (- (/ M 2.0))) (= b (- (/ M 2.0))))))\n");
  check("|s ei| <= M, and less unless |ei| = M", "unsat",
        "(assert (<= 0.0 s 1.0))\n(assert (> M 0.0))\n(assert (<= (size ei) M))\n(assert (= xi (* s ei)))\n"
        "(assert (or (> (size xi) M) (and (= (size xi) M) (< (size ei) M))))\n");
  fmt::print("(declare-const p Int)\n(declare-const q Int)\n");
  check("integers within half a unit are equal: |e| = M is rounded without error", "unsat",
        "(assert (<= (- 1) (* 2 (- p q)) 1))\n(assert (distinct p q))\n");
  for (int n = hls::IntBits::min_coord; n <= hls::IntBits::max_coord; ++n) {
    const std::int64_t most = (std::int64_t{1} << (n - 1)) - 1;
    std::string wrong;
    for (int t = hls::IntBits::min_interval; t <= 2 * n - 1; ++t) {
      const std::int64_t unit = std::int64_t{1} << (2 * n - 1 - t);
      wrong += fmt::format(" (< (- (div q {0}) (div p {0})) {1})", unit,
                           integer(hls::int_plucker::edge_bound({n, t})));
    }
    check(fmt::format("q - p > -M: trimmed, >= EBND, n = {}, t = 6..{}", n, 2 * n - 1), "unsat",
          fmt::format("(assert (> (- q p) {}))\n(assert (or{}))\n", integer(-most), wrong));
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string lemma = argc > 1 ? argv[1] : "";
    if (lemma == "trimming" && argc == 2) {
      trimming();
    } else if (lemma == "products" && argc == 2) {
      products();
    } else if (lemma == "pieces" && argc == 2) {
      pieces();
    } else if (lemma == "shifts" && argc == 2) {
      shifts();
    } else if (lemma == "saturation" && argc == 2) {
      saturation();
    } else if (lemma == "bound" && argc == 2) {
      bound();
    } else if (lemma == "attained" && argc == 3) {
      attained(std::stoi(argv[2]));
    } else {
      throw std::runtime_error(
          "usage: emit_lemmas trimming | products | pieces | shifts | saturation | bound | attained N");
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
