// The tests that a board is given: operands, and the results by the design's C++.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/draw.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::sim {

class BoardTests {
 public:
  virtual ~BoardTests() = default;
  /// Nothing when there are no more.
  virtual std::optional<rtl::Vector> next() = 0;
};

/// As many as design_vectors() makes for a testbench.
[[nodiscard]] std::unique_ptr<BoardTests> drawn_tests(const rtl::Design& design, const Format& format,
                                                      std::size_t count, std::uint64_t seed);

/// The image from which pixels are drawn.
struct SceneTestOptions {
  int width = 256;
  int height = 256;
  std::uint64_t seed = 1;
  ref::WhittedOptions light{};
};

/// The tests of pixels drawn at random, one ray after the other: primary rays and all that they cause. There
/// is no end of them. The C++ results steer the traversal. Scene and hierarchy must outlive the tests. Throws
/// as make_feed() does; next() throws std::runtime_error when the unit takes none of the scene's rays.
[[nodiscard]] std::unique_ptr<BoardTests> scene_tests(const rtl::Design& design, const Format& format,
                                                      const ref::Scene& scene, const ref::Bvh& bvh,
                                                      const SceneTestOptions& options);

}  // namespace hitpipe::sim
