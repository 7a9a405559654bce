#include "sim/board/board_tests.hpp"

#include <deque>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rays/exact/box_referee.hpp"
#include "sim/cosim/walk.hpp"
#include "sim/software/feed.hpp"
#include "sim/vectors/design_vectors.hpp"

namespace hitpipe::sim {

namespace {

class DrawnTests final : public BoardTests {
 public:
  explicit DrawnTests(std::vector<rtl::Vector> vectors) : vectors_(std::move(vectors)) {}
  std::optional<rtl::Vector> next() override {
    if (given_ == vectors_.size()) return std::nullopt;
    return vectors_[given_++];
  }

 private:
  std::vector<rtl::Vector> vectors_;
  std::size_t given_ = 0;
};

struct BoardScene {
  const ref::Scene& scene;
  const ref::Bvh& bvh;
  SceneTestOptions options;
};

template <class Walk>
class SceneTests final : public BoardTests {
 public:
  SceneTests(const rtl::Design& design, const Format& format, const BoardScene& scene,
             std::unique_ptr<SceneFeed> feed, const Walk& walk)
      : scene_(scene),
        feed_(std::move(feed)),
        rays_(feed_->unit(1)),
        walk_(walk),
        evaluate_(design.evaluate(format)),
        whitted_(scene.scene, scene.options.light),
        random_(scene.options.seed),
        operand_count_(design.ports(format).size()) {}

  std::optional<rtl::Vector> next() override {
    while (!traversal_ || traversal_->done()) {
      if (traversal_) end(traversal_->hit().triangle);
      traversal_.reset();
      start();
    }
    rtl::Vector test{std::vector<std::int64_t>(operand_count_),
                     std::vector<std::int64_t>(evaluate_.result_count())};
    Walk::ask(*rays_, 0, *traversal_, test.operands.data());
    evaluate_(test.operands.data(), test.results.data());
    walk_.answer(*rays_, 0, *traversal_, test.results.data());
    return test;
  }

 private:
  static constexpr int most_refused = 100'000;

  void start() {
    for (int refused = 0; refused < most_refused; ++refused) {
      task_ = next_task();
      if (ref::acceptable(task_.ray)) {
        traversal_.emplace(walk_.start(*rays_, 0, task_.ray, task_.query()));
        return;
      }
      end(ref::Hit::none);
    }
    throw std::runtime_error(fmt::format("{}: none of its rays starts inside the cube", scene_.scene.name));
  }

  ref::RayTask next_task() {
    if (!waiting_.empty()) {
      const ref::RayTask task = waiting_.front();
      waiting_.pop_front();
      return task;
    }
    const auto below = [&](int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); };
    const int x = below(scene_.options.width);
    const int y = below(scene_.options.height);
    return whitted_.primary(x, y, scene_.options.width, scene_.options.height,
                            static_cast<std::uint32_t>(y * scene_.options.width + x));
  }

  void end(std::uint32_t triangle) {
    std::vector<ref::RayTask> caused;
    ref::LightSum light;
    whitted_.end(task_, triangle, light, caused);
    waiting_.insert(waiting_.end(), caused.begin(), caused.end());
  }

  BoardScene scene_;
  std::unique_ptr<SceneFeed> feed_;
  std::unique_ptr<RayFeed> rays_;
  Walk walk_;
  rtl::Evaluate evaluate_;
  ref::Whitted whitted_;
  std::mt19937_64 random_;
  std::size_t operand_count_;
  std::deque<ref::RayTask> waiting_;
  ref::RayTask task_;
  std::optional<typename Walk::Traversal> traversal_;
};

}  // namespace

std::unique_ptr<BoardTests> drawn_tests(const rtl::Design& design, const Format& format, std::size_t count,
                                        std::uint64_t seed) {
  return std::make_unique<DrawnTests>(design_vectors(design, format, count, seed).all());
}

std::unique_ptr<BoardTests> scene_tests(const rtl::Design& design, const Format& format,
                                        const ref::Scene& scene, const ref::Bvh& bvh,
                                        const SceneTestOptions& options) {
  std::unique_ptr<SceneFeed> feed = make_feed(design, format, bvh);
  const std::vector<hls::Result> results = design.results(format);
  std::unique_ptr<BoardTests> tests;
  with_walk({feed.get(), &bvh, &scene.mesh}, results, [&](const auto& walk) {
    using Walk = std::decay_t<decltype(walk)>;
    tests = std::make_unique<SceneTests<Walk>>(design, format, BoardScene{scene, bvh, options},
                                               std::move(feed), walk);
  });
  return tests;
}

}  // namespace hitpipe::sim
