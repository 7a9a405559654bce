// A stand-in for ac_types' ac_int.h, so that the C++14 build is tested without it: only what hitpipe uses, with the
// widths of ac_int's rules. Like there, ~x is the signed number -x-1. C++14.
#pragma once

#include <type_traits>

#include "word.h"

template <int W, bool S>
class ac_int {
 public:
  ac_int() = default;
  template <class T, typename std::enable_if<std::is_integral<T>::value, int>::type = 0>
  ac_int(T value) : value_(word::number<W, S>(static_cast<word::pattern>(value))) {}
  template <int W2, bool S2>
  ac_int(const ac_int<W2, S2>& other)
      : value_(word::number<W, S>(static_cast<word::pattern>(other.value()))) {}

  word::wide value() const { return value_; }
  static ac_int of(word::wide value) {
    ac_int x;
    x.value_ = word::number<W, S>(static_cast<word::pattern>(value));
    return x;
  }

  template <int Width>
  ac_int<Width, S> slc(int low) const {
    return ac_int<Width, S>::of(value_ >> low);
  }
  template <int W2, bool S2>
  ac_int& set_slc(int low, const ac_int<W2, S2>& part) {
    const word::pattern ones = ((word::pattern(1) << W2) - 1) << low;
    const word::pattern kept = static_cast<word::pattern>(value_) & ~ones;
    const word::pattern put = static_cast<word::pattern>(part.value()) << low & ones;
    return *this = of(static_cast<word::wide>(kept | put));
  }
  ac_int<W + !S, true> operator~() const { return ac_int<W + !S, true>::of(~value_); }
  std::uint64_t to_uint64() const { return static_cast<std::uint64_t>(value_); }

 private:
  word::wide value_ = 0;
};

namespace word {

template <int A, bool SA, int B, bool SB>
struct AcCommon {
  static const int width = max(Beside<A, SA, SB>::width, Beside<B, SB, SA>::width);
  typedef ac_int<width, SA || SB> logic;
  typedef ac_int<width + 1, SA || SB> sum;
  typedef ac_int<width + 1, true> difference;
};

}  // namespace word

template <int A, bool SA, int B, bool SB>
typename word::AcCommon<A, SA, B, SB>::sum operator+(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return word::AcCommon<A, SA, B, SB>::sum::of(a.value() + b.value());
}
template <int A, bool SA, int B, bool SB>
typename word::AcCommon<A, SA, B, SB>::difference operator-(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return word::AcCommon<A, SA, B, SB>::difference::of(a.value() - b.value());
}
template <int A, bool SA, int B, bool SB>
ac_int<A + B, SA || SB> operator*(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return ac_int<A + B, SA || SB>::of(a.value() * b.value());
}
template <int A, bool SA, int B, bool SB>
typename word::AcCommon<A, SA, B, SB>::logic operator&(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return word::AcCommon<A, SA, B, SB>::logic::of(a.value() & b.value());
}
template <int A, bool SA, int B, bool SB>
typename word::AcCommon<A, SA, B, SB>::logic operator|(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return word::AcCommon<A, SA, B, SB>::logic::of(a.value() | b.value());
}
template <int A, bool SA, int B, bool SB>
typename word::AcCommon<A, SA, B, SB>::logic operator^(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return word::AcCommon<A, SA, B, SB>::logic::of(a.value() ^ b.value());
}
template <int A, bool SA, int B, bool SB>
bool operator<(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return a.value() < b.value();
}
template <int A, bool SA, int B, bool SB>
bool operator>(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return b < a;
}
template <int A, bool SA, int B, bool SB>
bool operator<=(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return !(b < a);
}
template <int A, bool SA, int B, bool SB>
bool operator==(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return a.value() == b.value();
}
template <int A, bool SA, int B, bool SB>
bool operator!=(const ac_int<A, SA>& a, const ac_int<B, SB>& b) {
  return !(a == b);
}
template <int A, bool SA>
bool operator!=(const ac_int<A, SA>& a, int b) {
  return a.value() != b;
}
