// Parts of an ap_int that can be read and written in place: x[i], x.range(hi, lo) or x(hi, lo), and (a, b).
// As operands they are unsigned: a bit is 1 bit wide, a range is as wide as its parent (the vendors' rule, as
// its bounds may vary at run time), and a concatenation is as wide as both sides together. length() counts
// the bits it really holds. A part of an lvalue refers to it and must not outlive it. Any other part holds a
// copy and is read only.
#pragma once

#include <type_traits>
#include <utility>

#include "hls/num/ap_base.hpp"

namespace hitpipe::hls {

template <class Bits>
struct Shape<RangeRef<Bits>> {
  static constexpr int width = std::remove_reference_t<Bits>::width;
  static constexpr bool is_signed = false;
  static constexpr bool ap = true;
};
template <int W, bool S>
struct Shape<BitRef<W, S>> {
  static constexpr int width = 1;
  static constexpr bool is_signed = false;
  static constexpr bool ap = true;
};
template <class Hi, class Lo>
struct Shape<ConcatRef<Hi, Lo>> {
  static constexpr int width =
      Shape<std::remove_reference_t<Hi>>::width + Shape<std::remove_reference_t<Lo>>::width;
  static constexpr bool is_signed = false;
  static constexpr bool ap = true;
};

template <class T>
inline constexpr bool writable_part = false;
template <int W, bool S>
inline constexpr bool writable_part<ap_base<W, S>&> = true;
template <int W, bool S>
inline constexpr bool writable_part<BitRef<W, S>> = true;
template <class Bits>
inline constexpr bool writable_part<RangeRef<Bits>> = writable_part<Bits>;
template <class Hi, class Lo>
inline constexpr bool writable_part<ConcatRef<Hi, Lo>> = writable_part<Hi>&& writable_part<Lo>;

/// Bits hi..lo of an ap_base (Bits is a reference) or of a copy of one.
template <class Bits>
class RangeRef {
  using Parent = std::remove_reference_t<Bits>;
  using Word = typename Parent::word_type;

 public:
  using value_type = ap_uint<Parent::width>;

  constexpr RangeRef(Bits bits, int hi, int lo) : bits_(bits), hi_(hi), lo_(lo) {
    assert(lo >= 0 && hi >= lo && hi < Parent::width);
  }
  constexpr RangeRef(const RangeRef&) = default;

  /// Writes the low length() bits of v.
  template <operand V>
  requires writable_part<Bits>
  constexpr RangeRef& operator=(const V& v) {
    const Word ones = words::low_ones<Word>(length());
    const Word held = bits_.word() & ~words::shift_left(ones, lo_);
    bits_ = Parent::wrapped(held | words::shift_left(value_type(v).word() & ones, lo_));
    return *this;
  }
  constexpr RangeRef& operator=(const RangeRef& v) requires writable_part<Bits> { return *this = v.value(); }

  constexpr value_type value() const {
    return value_type::exact(words::shift_right<false>(value_type(bits_).word(), lo_) &
                             words::low_ones<Word>(length()));
  }
  constexpr int length() const { return hi_ - lo_ + 1; }

  constexpr bool and_reduce() const { return value().word() == words::low_ones<Word>(length()); }
  constexpr bool or_reduce() const { return value().or_reduce(); }
  constexpr bool xor_reduce() const { return value().xor_reduce(); }
  constexpr bool to_bool() const { return value().to_bool(); }
  constexpr int to_int() const { return value().to_int(); }
  constexpr unsigned to_uint() const { return value().to_uint(); }
  constexpr std::int64_t to_int64() const { return value().to_int64(); }
  constexpr std::uint64_t to_uint64() const { return value().to_uint64(); }

 private:
  Bits bits_;
  int hi_;
  int lo_;
};

/// One bit of an ap_base.
template <int W, bool S>
class BitRef {
 public:
  constexpr BitRef(ap_base<W, S>& bits, int i) : bits_(bits), index_(i) { assert(i >= 0 && i < W); }
  constexpr BitRef(const BitRef&) = default;

  /// Writes 1 if v is not zero, else 0.
  template <operand V>
  constexpr BitRef& operator=(const V& v) {
    bits_.set_bit(index_, value_of(v).to_bool());
    return *this;
  }
  constexpr BitRef& operator=(const BitRef& v) { return *this = v.value(); }

  constexpr operator bool() const { return bits_.test(index_); }
  constexpr bool operator~() const { return !to_bool(); }
  constexpr bool to_bool() const { return bits_.test(index_); }
  constexpr ap_uint<1> value() const { return ap_uint<1>(to_bool()); }
  constexpr int length() const { return 1; }

 private:
  ap_base<W, S>& bits_;
  int index_;
};

/// Hi's bits above Lo's; each is an ap_base, a reference to one, or another part.
template <class Hi, class Lo>
class ConcatRef {
 public:
  using value_type = ap_uint<Shape<ConcatRef>::width>;

  constexpr ConcatRef(Hi hi, Lo lo) : hi_(hi), lo_(lo) {}
  constexpr ConcatRef(const ConcatRef&) = default;

  /// Lo takes the low bits of v, Hi those above.
  template <operand V>
  requires writable_part<ConcatRef>
  constexpr ConcatRef& operator=(const V& v) {
    const value_type all(v);
    lo_ = low_bits(all, lo_.length());
    hi_ = low_bits(all >> static_cast<unsigned>(lo_.length()), hi_.length());
    return *this;
  }
  constexpr ConcatRef& operator=(const ConcatRef& v) requires writable_part<ConcatRef> {
    return *this = v.value();
  }

  constexpr value_type value() const {
    return value_type(pattern(hi_)) << static_cast<unsigned>(lo_.length()) | value_type(pattern(lo_));
  }
  constexpr int length() const { return hi_.length() + lo_.length(); }
  constexpr std::int64_t to_int64() const { return value().to_int64(); }
  constexpr std::uint64_t to_uint64() const { return value().to_uint64(); }

 private:
  /// Only n bits of x. For a bit: 1 if x is not zero.
  static constexpr value_type low_bits(const value_type& x, int n) {
    return value_type::exact(x.word() & words::low_ones<typename value_type::word_type>(n));
  }
  template <class Part>
  static constexpr auto pattern(const Part& part) {
    return ap_uint<Shape<Part>::width>(part);
  }

  Hi hi_;
  Lo lo_;
};

template <class Bits>
constexpr auto value_of(const RangeRef<Bits>& part) {
  return part.value();
}
template <int W, bool S>
constexpr auto value_of(const BitRef<W, S>& part) {
  return part.value();
}
template <class Hi, class Lo>
constexpr auto value_of(const ConcatRef<Hi, Lo>& part) {
  return part.value();
}

/// What a concatenation keeps of an operand A&&: a reference to an lvalue ap_base, or else the value.
template <class A>
struct PartOf {
  using type = std::remove_cvref_t<A>;
};
template <std::integral T>
struct PartOf<T> {
  using type = ap_base<Shape<T>::width, Shape<T>::is_signed>;
};
template <class T>
requires std::integral<std::remove_cvref_t<T>>
struct PartOf<T&> : PartOf<std::remove_cv_t<T>> {
};
template <int W, bool S>
struct PartOf<ap_base<W, S>&> {
  using type = ap_base<W, S>&;
};

/// The concatenation (a, b).
template <class A, class B>
requires operands<std::remove_cvref_t<A>, std::remove_cvref_t<B>>
constexpr auto operator,(A&& a, B&& b) {
  return ConcatRef<typename PartOf<A>::type, typename PartOf<B>::type>(a, b);
}

template <int W, bool S>
template <class B>
constexpr auto ap_base<W, S>::concat(B&& b) & {
  return operator,(*this, std::forward<B>(b));
}
template <int W, bool S>
template <class B>
constexpr auto ap_base<W, S>::concat(B&& b) const& {
  return operator,(*this, std::forward<B>(b));
}

template <int W, bool S>
constexpr RangeRef<ap_base<W, S>&> ap_base<W, S>::range(int hi, int lo) & {
  return {*this, hi, lo};
}
template <int W, bool S>
constexpr RangeRef<ap_base<W, S>> ap_base<W, S>::range(int hi, int lo) const& {
  return {*this, hi, lo};
}
template <int W, bool S>
constexpr RangeRef<ap_base<W, S>&> ap_base<W, S>::operator()(int hi, int lo) & {
  return {*this, hi, lo};
}
template <int W, bool S>
constexpr RangeRef<ap_base<W, S>> ap_base<W, S>::operator()(int hi, int lo) const& {
  return {*this, hi, lo};
}
template <int W, bool S>
constexpr BitRef<W, S> ap_base<W, S>::operator[](int i) & {
  return {*this, i};
}
template <int W, bool S>
constexpr BitRef<W, S> ap_base<W, S>::bit(int i) & {
  return {*this, i};
}

}  // namespace hitpipe::hls
