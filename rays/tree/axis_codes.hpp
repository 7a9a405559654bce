// Chooses the codes of a box's planes in a frame, rounded outward. A frame is a class with
//   top                 the largest code
//   decoded(axis, code)  the coordinate; it does not fall when the code rises
//   origin(axis), step(axis)
// Code 0 decodes to the frame's origin, and the top code to at least its far end.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hitpipe::ref {

/// Codes of one axis whose decoded coordinates contain [min, max] of a box inside the frame. The first guess
/// is at most a few codes off.
template <class Frame>
class AxisCodes {
 public:
  AxisCodes(const Frame& frame, int axis) : frame_(frame), axis_(axis) {}

  /// The largest decoded coordinate <= min.
  [[nodiscard]] std::uint32_t below(float min) const {
    std::uint32_t code = guess(min);
    while (code > 0 && decoded(code) > min) --code;
    while (code < Frame::top && decoded(code) < min && decoded(code + 1) <= min) ++code;
    return code;
  }
  /// The least decoded coordinate >= max.
  [[nodiscard]] std::uint32_t above(float max) const {
    std::uint32_t code = guess(max);
    while (code < Frame::top && decoded(code) < max) ++code;
    while (code > 0 && decoded(code) > max && decoded(code - 1) >= max) --code;
    return code;
  }

 private:
  [[nodiscard]] float decoded(std::uint32_t code) const {
    return frame_.decoded(axis_, static_cast<float>(code));
  }
  [[nodiscard]] std::uint32_t guess(float x) const {
    const double code = (static_cast<double>(x) - frame_.origin(axis_)) / frame_.step(axis_);
    return static_cast<std::uint32_t>(std::clamp(code, 0.0, static_cast<double>(Frame::top)));
  }

  const Frame& frame_;
  int axis_;
};

}  // namespace hitpipe::ref
