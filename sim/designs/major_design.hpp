// What the software of all designs with a major axis shares: the operands of a ray, and formats.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hls/box/int_major_operands.hpp"
#include "hls/box/int_major_pair_operands.hpp"
#include "hls/box/major_format.hpp"
#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_major_ray.hpp"
#include "rays/world/pair_nodes.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim {

void put_major_ray(const ref::IntMajorRay& ray, hls::MajorRay<Words, hls::MajorBits>& in);
/// Two boxes, and where the ray is within their parent.
void put_pair(const ref::RayInterval& parent, const ref::PairBoxes& boxes,
              hls::IntMajorPairOperands<Words, hls::MajorBits>& in);

/// A ray of either world: a format with S is one of the integer world (docs/integer_world.md), where the door
/// makes the ray.
class MajorSetup {
 public:
  MajorSetup(const ref::Ray& ray, const hls::MajorBits& bits);

  [[nodiscard]] const ref::IntMajorRay& ray() const { return ray_; }
  /// floor(length |D_M| G 2^F), at most the largest length in the cube. Throws std::invalid_argument unless
  /// length >= 0.
  [[nodiscard]] std::int64_t length(float length) const;

 private:
  hls::MajorBits bits_;
  float major_;  ///< |D_M|
  ref::IntMajorRay ray_;
};

/// Boxes as a unit of this format reads them: grown, or in the integer world rounded to the nearest integers.
void major_boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<ref::IntBox> out);
/// What is true of a ray and boxes in the integer world. False: the format is of the float world.
bool integer_meet(const ref::Ray& ray, std::span<const ref::Aabb> boxes, const Format& format,
                  std::span<bool> out);
/// Throws std::runtime_error, one line, for a format of the integer world: a scene of floats cannot be traced
/// there.
[[nodiscard]] hls::MajorBits float_world(const Format& format);

/// The software of a design without its own set-up: feed, box_test and tracer are missing.
[[nodiscard]] Software major_design_software();

}  // namespace hitpipe::sim
