#include <algorithm>
#include <cmath>
#include <vector>

#include "rays/exact/grid.hpp"
#include "tests/sim/check/mutations.hpp"

namespace hitpipe::sim {
namespace {

using ref::Aabb;
using ref::Ray;

// Ports of hls::IntSlabsOperands.
constexpr std::size_t irlen = 3;
constexpr std::size_t irdvc_floor_x = 4;
constexpr std::size_t slabs_rinf = 10;
// Ports of hls::IntPluckerOperands.
constexpr std::size_t endpoint_x = 3;
constexpr std::size_t direction_x = 6;
constexpr std::size_t pluecker_rinf = 9;

class MutatedSetup final : public BoxTest {
 public:
  MutatedSetup(const rtl::Design& design, const Format& format, SetupFault* fault)
      : right_(make_box_test(design, format)),
        evaluate_(design.evaluate(format)),
        format_(format),
        fault_(fault) {}

  void start(const Ray& ray) override {
    ray_ = ray;
    right_->start(ray);
  }
  bool hit(const Aabb& box) override {
    (void)right_->hit(box);
    operands_.assign(right_->operands().begin(), right_->operands().end());
    fault_(ray_, box, format_, operands_);
    return evaluate_(operands_.data());
  }

 private:
  std::unique_ptr<BoxTest> right_;
  rtl::Evaluate evaluate_;
  Format format_;
  SetupFault* fault_;
  Ray ray_;
  std::vector<std::int64_t> operands_;
};

/// G x; exact up to 24 bits.
double on_grid(float x, hls::IntBits bits) {
  return static_cast<double>(ref::grid_scale(bits.coord)) * x;
}
std::int64_t whole(double x) {
  return static_cast<std::int64_t>(x);
}
/// M = 2^(n-1) - 1.
double limit(hls::IntBits bits) {
  return std::ldexp(1.0, bits.coord - 1) - 1;
}
int at(std::size_t axis) {
  return static_cast<int>(axis);
}
float smallest(const glm::vec3& d) {
  return std::min({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
}
/// length * scale, rounded only as doubles are. 0 if a component is 0.
double scaled_length(const Ray& ray, hls::IntBits bits) {
  return ray.length * (limit(bits) * smallest(ray.direction));
}
double endpoint(const Ray& ray, std::size_t axis) {
  const int i = at(axis);
  return ray.origin[i] + static_cast<double>(ray.length) * ray.direction[i];
}

}  // namespace

std::unique_ptr<BoxTest> mutated_set_up(const rtl::Design& design, const Format& format, SetupFault* fault) {
  return std::make_unique<MutatedSetup>(design, format, fault);
}

void half_unit_left_out(const Ray& /*ray*/, const Aabb& box, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  const Operands faces = in.last(6);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    faces[2 * axis] = whole(std::floor(on_grid(box.min[at(axis)], bits)));
    faces[2 * axis + 1] = whole(std::ceil(on_grid(box.max[at(axis)], bits)));
  }
}

void box_rounded_to_nearest(const Ray& /*ray*/, const Aabb& box, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  const Operands faces = in.last(6);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    faces[2 * axis] = whole(std::round(on_grid(box.min[at(axis)], bits) - 0.5));
    faces[2 * axis + 1] = whole(std::round(on_grid(box.max[at(axis)], bits) + 0.5));
  }
}

void box_in_binary32(const Ray& /*ray*/, const Aabb& box, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  const auto unit = static_cast<float>(ref::grid_scale(bits.coord));
  const Operands faces = in.last(6);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    faces[2 * axis] = whole(std::floor(unit * box.min[at(axis)] - 0.5F));
    faces[2 * axis + 1] = whole(std::ceil(unit * box.max[at(axis)] + 0.5F));
  }
}

void origin_truncated(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  for (std::size_t axis = 0; axis < 3; ++axis) in[axis] = whole(on_grid(ray.origin[at(axis)], bits));
}

void irdvc_in_binary32(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  const float least = smallest(ray.direction);
  const float scale = static_cast<float>(limit(bits)) * least;
  if (least == 0 || std::isinf(scale)) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float quotient = scale / ray.direction[at(axis)];
    in[irdvc_floor_x + 2 * axis] = whole(std::floor(quotient));
    in[irdvc_floor_x + 2 * axis + 1] = whole(std::ceil(quotient));
  }
}

void irdvc_in_binary32_clamped(const Ray& ray, const Aabb& box, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  irdvc_in_binary32(ray, box, bits, in);
  for (std::int64_t& bound : in.subspan(irdvc_floor_x, 6)) {
    bound = std::clamp(bound, -whole(limit(bits)), whole(limit(bits)));
  }
}

void irdvc_below_one_is_zero(const Ray& /*ray*/, const Aabb& /*box*/, const Format& /*format*/, Operands in) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Operands bounds = in.subspan(irdvc_floor_x + 2 * axis, 2);
    if (bounds[0] == 0 || bounds[1] == 0) bounds[0] = bounds[1] = 0;
  }
}

void irlen_not_saturated(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  const double full = scaled_length(ray, bits) * static_cast<double>(ref::grid_scale(bits.coord));
  const double range = std::ldexp(1.0, bits.product());
  if (!std::isfinite(full) || full < range / 2) return;
  const double wrapped = std::fmod(full, range);
  const double kept = wrapped < range / 2 ? wrapped : wrapped - range;
  in[irlen] = whole(std::floor(std::ldexp(kept, -bits.trimmed())));
}

void irlen_trimmed_one_bit_more(const Ray& /*ray*/, const Aabb& /*box*/, const Format& /*format*/,
                                Operands in) {
  in[irlen] /= 2;
}

void irlen_floored_before_the_grid(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  const double full = std::floor(scaled_length(ray, bits)) * static_cast<double>(ref::grid_scale(bits.coord));
  const double trimmed = std::floor(std::ldexp(full, -bits.trimmed()));
  if (trimmed < static_cast<double>(in[irlen])) in[irlen] = whole(trimmed);
}

void endpoint_clamped(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  if (in[pluecker_rinf] == 0 || ray.is_infinite()) return;
  in[pluecker_rinf] = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double end = std::clamp(endpoint(ray, axis), -1.0, 1.0);
    const double on = static_cast<double>(ref::grid_scale(bits.coord)) * end;
    in[endpoint_x + axis] = whole(ray.direction[at(axis)] < 0 ? std::floor(on) : std::ceil(on));
  }
}

void pluecker_rinf_ignored(const Ray& /*ray*/, const Aabb& /*box*/, const Format& /*format*/, Operands in) {
  in[pluecker_rinf] = 0;
}

void slabs_rinf_ignored(const Ray& /*ray*/, const Aabb& /*box*/, const Format& /*format*/, Operands in) {
  in[slabs_rinf] = 0;
}

void endpoint_rounded_inward(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  if (in[pluecker_rinf] != 0) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double on = static_cast<double>(ref::grid_scale(bits.coord)) * endpoint(ray, axis);
    in[endpoint_x + axis] = whole(ray.direction[at(axis)] < 0 ? std::ceil(on) : std::floor(on));
  }
}

void direction_truncated(const Ray& ray, const Aabb& /*box*/, const Format& format, Operands in) {
  const auto bits = format.as<hls::IntBits>();
  const glm::vec3& d = ray.direction;
  const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    in[direction_x + axis] = whole(limit(bits) * d[at(axis)] / largest);
    // The rule of the set-up: a backward component that became 0 ends where it began, rounded up.
    const bool became_zero = d[at(axis)] < 0 && in[direction_x + axis] == 0 && in[pluecker_rinf] == 0;
    if (became_zero) in[endpoint_x + axis] = whole(std::ceil(on_grid(ray.origin[at(axis)], bits)));
  }
}

}  // namespace hitpipe::sim
