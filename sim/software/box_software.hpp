// A ray-box test as a whole, with set-up and datapath, as the check judges it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

/// For one thread only.
class BoxTest {
 public:
  virtual ~BoxTest() = default;
  virtual void start(const ref::Ray& ray) = 0;
  /// Tests the started ray against a box.
  virtual bool hit(const ref::Aabb& box) = 0;
  /// Tests it against each of the boxes in turn.
  virtual void hits(std::span<const ref::Aabb> boxes, std::span<bool> out) {
    for (std::size_t i = 0; i < boxes.size(); ++i) out[i] = hit(boxes[i]);
  }
  /// What is true of a ray and each of the boxes: the answers that hits() is judged by. They are exact for
  /// the numbers as given, or, for a unit of the integer world, for the integers that they are rounded to.
  virtual void meet(const ref::Ray& ray, std::span<const ref::Aabb> boxes, std::span<bool> out) const;
  [[nodiscard]] bool meets(const ref::Ray& ray, const ref::Aabb& box) const {
    bool met = false;
    meet(ray, {&box, 1}, {&met, 1});
    return met;
  }
  /// Tests it against two children of one parent, for a design that answers for two boxes at a time. Their
  /// common box is tested first, as at a root. If the ray misses it, the last test is that one. Throws
  /// std::logic_error where the design answers for one box.
  virtual std::array<bool, 2> siblings(const ref::Aabb& first, const ref::Aabb& second);
  /// The operands that a Verilated design gets for the last test, in port order. Empty if the test has none.
  [[nodiscard]] virtual std::span<const std::int64_t> operands() const { return {}; }
  /// All results that the design must then give; empty if it has none.
  [[nodiscard]] virtual std::span<const std::int64_t> results() const { return {}; }
};

using MakeBoxTest = std::function<std::unique_ptr<BoxTest>()>;

/// A design's set-up with its C++ datapath. Throws std::runtime_error, one line, when the design has no
/// set-up, and what Design::evaluate() throws.
[[nodiscard]] std::unique_ptr<BoxTest> make_box_test(const rtl::Design& design, const Format& format);

/// Slabs in binary32, with the far distance widened by 2 ulp: "Robust BVH Ray Traversal" (Ize, 2013).
[[nodiscard]] std::unique_ptr<BoxTest> ize_slabs_test();

}  // namespace hitpipe::sim
