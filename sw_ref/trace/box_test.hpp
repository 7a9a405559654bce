// What the traversal loops require of a box test.
#pragma once

#include <concepts>

namespace hitpipe::ref {

/// A box test belongs to one ray; a functor of (const Ray&) makes it. After cut(length) it may call a box a
/// miss that the ray enters only beyond t = length.
template <class T, class Box>
concept BoxTest = requires(T test, const T& asked, const Box& box, float length) {
  test.cut(length);
  { asked(box) } -> std::same_as<bool>;
};

}  // namespace hitpipe::ref
