#include "sim/software/step_feed.hpp"

#include <array>
#include <stdexcept>
#include <utility>

namespace hitpipe::sim {

namespace {

class SteppedRays final : public RayFeed {
 public:
  SteppedRays(std::unique_ptr<RayFeed> rays, const OperandStep& step) : rays_(std::move(rays)), step_(step) {}

  void start(std::size_t slot, const ref::Ray& ray) override { rays_->start(slot, ray); }
  void operands(std::size_t slot, const Question& asked, std::int64_t* out) override {
    rays_->operands(slot, asked, out);
    step_(out);
  }
  [[nodiscard]] std::int64_t in_results(std::size_t slot, float length) const override {
    return rays_->in_results(slot, length);
  }

 private:
  std::unique_ptr<RayFeed> rays_;
  const OperandStep& step_;
};

class SteppedScene final : public SceneFeed {
 public:
  SteppedScene(std::unique_ptr<SceneFeed> feed, OperandStep step)
      : feed_(std::move(feed)), step_(std::move(step)) {}

  [[nodiscard]] std::unique_ptr<RayFeed> unit(std::size_t slots) const override {
    return std::make_unique<SteppedRays>(feed_->unit(slots), step_);
  }
  [[nodiscard]] int boxes_per_test() const override { return feed_->boxes_per_test(); }

 private:
  std::unique_ptr<SceneFeed> feed_;
  OperandStep step_;
};

std::size_t place_of(const std::vector<rtl::Port>& ports, hls::Role role, hls::Axis axis) {
  const auto place = rtl::index_of(ports, role, axis);
  if (place && ports[*place].is_signed) return *place;
  throw std::invalid_argument("coarse axes: origin or box is not an integer; take an integer design");
}

struct Places {
  std::array<std::size_t, 3> origin{}, min{}, max{};

  explicit Places(const std::vector<rtl::Port>& ports) {
    std::size_t i = 0;
    for (const hls::Axis axis : {hls::Axis::x, hls::Axis::y, hls::Axis::z}) {
      origin[i] = place_of(ports, hls::Role::origin, axis);
      min[i] = place_of(ports, hls::Role::plane_low, axis);
      max[i] = place_of(ports, hls::Role::plane_high, axis);
      ++i;
    }
  }
};

}  // namespace

std::unique_ptr<SceneFeed> with_step(std::unique_ptr<SceneFeed> feed, OperandStep step) {
  return std::make_unique<SteppedScene>(std::move(feed), std::move(step));
}

OperandStep coarse_step(const std::vector<rtl::Port>& ports, const ref::CoarseAxes& coarse) {
  const Places at(ports);
  const int coord_bits = ports[at.origin[0]].width;
  ref::check_coarse(coarse, coord_bits, "coarse axes");
  return [at, coarse, coord_bits](std::int64_t* operands) {
    ref::IntOrigin origin{};
    ref::IntBox box;
    for (std::size_t i = 0; i < 3; ++i) {
      origin[i] = static_cast<std::int32_t>(operands[at.origin[i]]);
      box.min[i] = static_cast<std::int32_t>(operands[at.min[i]]);
      box.max[i] = static_cast<std::int32_t>(operands[at.max[i]]);
    }
    origin = ref::coarse_origin(origin, coarse, coord_bits);
    box = ref::coarse_box(box, coarse, coord_bits);
    for (std::size_t i = 0; i < 3; ++i) {
      operands[at.origin[i]] = origin[i];
      operands[at.min[i]] = box.min[i];
      operands[at.max[i]] = box.max[i];
    }
  };
}

OperandStep endless_step(const std::vector<rtl::Port>& ports) {
  const auto at = rtl::index_of(ports, hls::Role::endless);
  if (!at) throw std::invalid_argument("endless rays: no operand says that a ray has no end");
  return [at = *at](std::int64_t* operands) { operands[at] = 1; };
}

}  // namespace hitpipe::sim
