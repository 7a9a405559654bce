#include "sim/feeds/with_step.hpp"

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

}  // namespace

std::unique_ptr<SceneFeed> with_step(std::unique_ptr<SceneFeed> feed, OperandStep step) {
  return std::make_unique<SteppedScene>(std::move(feed), std::move(step));
}

}  // namespace hitpipe::sim
