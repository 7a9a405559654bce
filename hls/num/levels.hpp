// Code that depends on widths: a loop over levels and a choice. If widths are types, each level may give a
// value of another type, so the loop is unrolled and a branch that is not taken is not compiled. If widths
// are ints it is a loop and an if.
#pragma once

#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

template <int Level, int Count>
struct Levels {
  template <class X, class Step>
  static constexpr auto from(const X& x, const Step& step) {
    return Levels<Level + 1, Count>::from(step(x, Width<Level>()), step);
  }
};
template <int Count>
struct Levels<Count, Count> {
  template <class X, class Step>
  static constexpr X from(const X& x, const Step& /*step*/) {
    return x;
  }
};

/// x = step(x, level) for level = 0 .. count-1.
template <int Count, class X, class Step>
constexpr auto for_each_level(Width<Count> /*count*/, const X& x, const Step& step) {
  return Levels<0, Count>::from(x, step);
}
template <class X, class Step>
constexpr X for_each_level(int count, X x, const Step& step) {
  for (int level = 0; level < count; ++level) x = step(x, level);
  return x;
}

/// change(x) if the condition holds, else x. Code that may not compile otherwise must depend on the argument
/// of change.
template <class X, class Change>
constexpr auto change_if(Truth<true> /*condition*/, const X& x, const Change& change) {
  return change(x);
}
template <class X, class Change>
constexpr X change_if(Truth<false> /*condition*/, const X& x, const Change& /*change*/) {
  return x;
}
template <class X, class Change>
constexpr X change_if(bool condition, const X& x, const Change& change) {
  if (condition) return change(x);
  return x;
}

/// then(x) if the condition holds, else otherwise(x). Only the one that is called must compile.
template <class X, class Then, class Otherwise>
constexpr auto either(Truth<true> /*condition*/, const X& x, const Then& then, const Otherwise&) {
  return then(x);
}
template <class X, class Then, class Otherwise>
constexpr auto either(Truth<false> /*condition*/, const X& x, const Then&, const Otherwise& otherwise) {
  return otherwise(x);
}
template <class X, class Then, class Otherwise>
constexpr auto either(bool condition, const X& x, const Then& then, const Otherwise& otherwise) {
  return condition ? then(x) : otherwise(x);
}

}  // namespace hls
}  // namespace hitpipe
