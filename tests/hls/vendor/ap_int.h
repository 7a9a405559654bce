// A stand-in for a vendor's ap_int.h, so that the C++14 build is tested without one: only what hitpipe uses, with
// the widths of the vendors' rules. Like theirs, range() is as wide as its parent. C++14.
#pragma once

#include <type_traits>

#include "word.h"

template <int W>
class ap_int;
template <int W>
class ap_uint;

namespace word {

template <int W, bool S>
struct ApType {
  typedef ap_int<W> type;
};
template <int W>
struct ApType<W, false> {
  typedef ap_uint<W> type;
};
template <int W, bool S>
using ap = typename ApType<W, S>::type;

template <int W, bool S>
class ApBase {
 public:
  static const int width = W;

  ApBase() = default;
  template <class T, typename std::enable_if<std::is_integral<T>::value, int>::type = 0>
  ApBase(T value) : value_(number<W, S>(static_cast<pattern>(value))) {}
  template <int W2, bool S2>
  ApBase(const ApBase<W2, S2>& other) : value_(number<W, S>(static_cast<pattern>(other.value()))) {}

  wide value() const { return value_; }
  static ap<W, S> of(wide value) {
    ap<W, S> x;
    static_cast<ApBase&>(x).value_ = number<W, S>(static_cast<pattern>(value));
    return x;
  }

  ap_uint<W> range(int high, int low) const {
    const pattern ones = (pattern(1) << (high - low + 1)) - 1;
    return ApBase<W, false>::of(static_cast<wide>(static_cast<pattern>(value_) >> low & ones));
  }
  template <int W2, bool S2>
  ap_uint<W + W2> concat(const ApBase<W2, S2>& low) const {
    const pattern above = static_cast<pattern>(value_) << W2;
    const pattern below = static_cast<pattern>(number<W2, false>(static_cast<pattern>(low.value())));
    return ApBase<W + W2, false>::of(static_cast<wide>(above | below));
  }
  ap<W, S> operator~() const { return of(~value_); }
  std::uint64_t to_uint64() const { return static_cast<std::uint64_t>(value_); }

 private:
  wide value_ = 0;
};

template <int A, bool SA, int B, bool SB>
struct Common {
  static const int width = max(Beside<A, SA, SB>::width, Beside<B, SB, SA>::width);
};

template <int A, bool SA, int B, bool SB>
ap<Common<A, SA, B, SB>::width + 1, SA || SB> operator+(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return ApBase<Common<A, SA, B, SB>::width + 1, SA || SB>::of(a.value() + b.value());
}
template <int A, bool SA, int B, bool SB>
ap<Common<A, SA, B, SB>::width + 1, true> operator-(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return ApBase<Common<A, SA, B, SB>::width + 1, true>::of(a.value() - b.value());
}
template <int A, bool SA, int B, bool SB>
ap<A + B, SA || SB> operator*(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return ApBase<A + B, SA || SB>::of(a.value() * b.value());
}
template <int A, bool SA, int B, bool SB>
ap<Common<A, SA, B, SB>::width, SA || SB> operator&(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return ApBase<Common<A, SA, B, SB>::width, SA || SB>::of(a.value() & b.value());
}
template <int A, bool SA, int B, bool SB>
ap<Common<A, SA, B, SB>::width, SA || SB> operator|(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return ApBase<Common<A, SA, B, SB>::width, SA || SB>::of(a.value() | b.value());
}
template <int A, bool SA, int B, bool SB>
ap<Common<A, SA, B, SB>::width, SA || SB> operator^(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return ApBase<Common<A, SA, B, SB>::width, SA || SB>::of(a.value() ^ b.value());
}
template <int A, bool SA, int B, bool SB>
bool operator<(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return a.value() < b.value();
}
template <int A, bool SA, int B, bool SB>
bool operator>(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return b < a;
}
template <int A, bool SA, int B, bool SB>
bool operator<=(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return !(b < a);
}
template <int A, bool SA, int B, bool SB>
bool operator==(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return a.value() == b.value();
}
template <int A, bool SA, int B, bool SB>
bool operator!=(const ApBase<A, SA>& a, const ApBase<B, SB>& b) {
  return !(a == b);
}
template <int A, bool SA>
bool operator!=(const ApBase<A, SA>& a, int b) {
  return a.value() != b;
}

}  // namespace word

template <int W>
class ap_int : public word::ApBase<W, true> {
 public:
  using word::ApBase<W, true>::ApBase;
  ap_int() = default;
};
template <int W>
class ap_uint : public word::ApBase<W, false> {
 public:
  using word::ApBase<W, false>::ApBase;
  ap_uint() = default;
};
