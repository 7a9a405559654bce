// Integer slabs with three answers (section 8.2): the ray surely misses the box, surely meets it, or the bits
// do not suffice. IntSlabsTest gives the sure misses. A sure hit needs bounds from the other side: planes as
// far inside as their rounding can have moved them, the IRDVC bounds exchanged, and products rounded up.
#pragma once

#include <cstdint>

#include "rays/world/int_box.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

enum class Answer : std::uint8_t { miss, hit, ask };

class AdaptiveSlabs {
 public:
  /// Throws as IntSlabsRaySetup does.
  AdaptiveSlabs(const Ray& ray, hls::IntBits bits);

  /// `length` must be >= 0 or infinite.
  void cut(float length);

  /// `box` comes from quantise_box().
  [[nodiscard]] Answer operator()(const IntBox& box) const;

 private:
  IntSlabsRaySetup set_up_;
  int trimmed_;
  std::int64_t length_ = 0;
};

}  // namespace hitpipe::thesis
