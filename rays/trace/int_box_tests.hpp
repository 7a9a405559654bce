// One ray's walk through a hierarchy of the integer world, with either test of boxes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "rays/trace/int_major.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rays/trace/int_world.hpp"
#include "rays/world/int_meets.hpp"

namespace hitpipe::ref {

class ExactBoxes {
 public:
  /// The ray must outlive it.
  ExactBoxes(const IntRay& ray, const IntTracerOptions& options) : ray_(&ray), bits_(options.world) {}
  void cut(std::int64_t length) { length_ = length; }
  [[nodiscard]] bool operator()(const IntBox& box) const { return int_meets(*ray_, box, length_, bits_); }

 private:
  const IntRay* ray_;
  hls::WorldBits bits_;
  std::int64_t length_ = 0;
};

/// As int_major tests them. The options have a format of boxes.
class MajorBoxes {
 public:
  MajorBoxes(const IntRay& ray, const IntTracerOptions& options)
      : world_(options.world), bits_(*options.boxes), distances_(major_ray(ray, bits_), bits_) {}
  void cut(std::int64_t length) { length_ = in_box_units(length, world_, bits_); }
  [[nodiscard]] bool operator()(const IntBox& box) const { return distances_.meets(box, length_); }

 private:
  hls::WorldBits world_;
  hls::MajorBits bits_;
  MajorDistances distances_;
  std::int64_t length_ = 0;
};

/// Goes to the end of the walk. meets(triangle) is T, where the ray meets a triangle that is of interest: the
/// walk leaves out what lies beyond the best of them. It comes to every triangle that the ray may meet up to
/// there, once. `boxes` is of int_boxes() for the walk's hierarchy.
template <class Boxes, class Meets>
void walk_boxes(IntBoxWalk& walk, Boxes test, std::span<const IntBox> boxes, const Meets& meets) {
  test.cut(walk.length());
  while (!walk.done()) {
    if (!walk.at_triangle()) {
      walk.answer(test(boxes[walk.node()]));
      continue;
    }
    const std::optional<std::int64_t> t = meets(walk.triangle());
    walk.answer_triangle(t.has_value(), t.value_or(0));
    if (t) test.cut(walk.length());
  }
}

}  // namespace hitpipe::ref
