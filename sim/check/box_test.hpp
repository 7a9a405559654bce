// A ray-box test as a whole, set-up and datapath, as the check judges it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "rtl_gen/catalogue/design.hpp"
#include "sw_ref/geometry/aabb.hpp"
#include "sw_ref/geometry/ray.hpp"

namespace hitpipe::sim {

/// Used by one thread.
class BoxTest {
 public:
  virtual ~BoxTest() = default;
  virtual void start(const ref::Ray& ray) = 0;
  /// The started ray against a box.
  virtual bool hit(const ref::Aabb& box) = 0;
  /// The same for each of the boxes, in turn.
  virtual void hits(std::span<const ref::Aabb> boxes, std::span<bool> out) {
    for (std::size_t i = 0; i < boxes.size(); ++i) out[i] = hit(boxes[i]);
  }
  /// What a Verilated design would be given for the last hit(), in port order; empty if it has none.
  [[nodiscard]] virtual std::span<const std::int64_t> operands() const { return {}; }
  /// All results that the design must then give; empty if it has none.
  [[nodiscard]] virtual std::span<const std::int64_t> results() const { return {}; }
};

using MakeBoxTest = std::function<std::unique_ptr<BoxTest>()>;

/// A design of the catalogue: its set-up and its C++ datapath. Throws as make_feed() and Design::evaluate()
/// do.
[[nodiscard]] std::unique_ptr<BoxTest> make_box_test(const rtl::Design& design, const rtl::Format& format);

/// Slabs in binary32 whose far distance is widened by 2 ulp: "Robust BVH Ray Traversal" (Ize, 2013).
[[nodiscard]] std::unique_ptr<BoxTest> robust_float_slabs_test();

}  // namespace hitpipe::sim
