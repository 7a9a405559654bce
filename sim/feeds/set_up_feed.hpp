// What all feeds share: rays in slots, boxes by node, and the end of each ray, which is kept until it
// changes. A set-up S is constructed once for each ray, as S(ray, format). It has
//   S::Box, S::boxes(aabbs, format, out)   boxes as the design reads them
//   S::End, end(length)                    what depends on the ray's length
//   write(end, rinf, box, out)             writes the operands in port order
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "rtl_gen/catalogue/format.hpp"
#include "sim/check/box_test.hpp"
#include "sim/feed.hpp"

namespace hitpipe::sim {

/// Copies three components to consecutive ports.
template <class Vector>
std::int64_t* put(const Vector& v, std::int64_t* out) {
  for (const auto component : v) *out++ = component;
  return out;
}

/// min and max of each axis in turn. Every design reads its box in this order.
template <class Box>
void put_box(const Box& box, std::int64_t* out) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    *out++ = box.min[axis];
    *out++ = box.max[axis];
  }
}

template <class S>
class SetUpRays final : public RayFeed {
 public:
  SetUpRays(const std::vector<typename S::Box>& boxes, const rtl::Format& format, std::size_t slots)
      : boxes_(boxes), format_(format), slots_(slots, Slot(any_ray(), format)) {}

  void start(std::size_t slot, const ref::Ray& ray) override { slots_[slot] = Slot(ray, format_); }

  void operands(std::size_t slot, const Question& asked, std::int64_t* out) override {
    Slot& ray = slots_[slot];
    if (ray.length != asked.length) {
      ray.length = asked.length;
      ray.end = ray.set_up.end(asked.length);
    }
    ray.set_up.write(ray.end, std::isinf(asked.length), boxes_[asked.record], out);
  }

 private:
  struct Slot {
    Slot(const ref::Ray& ray, const rtl::Format& format)
        : set_up(ray, format), length(ray.length), end(set_up.end(ray.length)) {}

    S set_up;
    float length;
    typename S::End end;
  };
  static ref::Ray any_ray() { return {glm::vec3(0), glm::vec3(1), ref::Ray::infinite}; }

  const std::vector<typename S::Box>& boxes_;
  rtl::Format format_;
  std::vector<Slot> slots_;  // a ray's length changes only when a closer hit is found
};

template <class S>
class SetUpScene final : public SceneFeed {
 public:
  SetUpScene(const rtl::Format& format, const ref::Bvh& bvh) : format_(format) {
    std::vector<ref::Aabb> boxes;
    boxes.reserve(bvh.nodes.size());
    for (const ref::BvhNode& node : bvh.nodes) boxes.push_back(node.box);
    boxes_.resize(boxes.size());
    S::boxes(boxes, format, boxes_);
  }
  [[nodiscard]] std::unique_ptr<RayFeed> unit(std::size_t slots) const override {
    return std::make_unique<SetUpRays<S>>(boxes_, format_, slots);
  }

 private:
  rtl::Format format_;
  std::vector<typename S::Box> boxes_;
};

/// One ray at a time against given boxes. Only the last six ports, those of the box, change from box to box.
template <class S>
class SetUpTest final : public BoxTest {
 public:
  SetUpTest(const rtl::Design& design, const rtl::Format& format)
      : evaluate_(design.evaluate(format)),
        format_(format),
        operands_(design.ports(format).size()),
        results_(evaluate_.result_count()) {}

  void start(const ref::Ray& ray) override {
    const S set_up(ray, format_);
    const typename S::Box none_yet{};
    set_up.write(set_up.end(ray.length), std::isinf(ray.length), none_yet, operands_.data());
  }
  bool hit(const ref::Aabb& box) override {
    bool answer = false;
    hits({&box, 1}, {&answer, 1});
    return answer;
  }
  void hits(std::span<const ref::Aabb> boxes, std::span<bool> out) override {
    boxes_.resize(boxes.size());
    S::boxes(boxes, format_, boxes_);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      put_box(boxes_[i], operands_.data() + operands_.size() - 6);
      evaluate_(operands_.data(), results_.data());
      out[i] = evaluate_.hit(results_.data());
    }
  }
  [[nodiscard]] std::span<const std::int64_t> operands() const override { return operands_; }
  [[nodiscard]] std::span<const std::int64_t> results() const override { return results_; }

 private:
  rtl::Evaluate evaluate_;
  rtl::Format format_;
  std::vector<std::int64_t> operands_;
  std::vector<std::int64_t> results_;
  std::vector<typename S::Box> boxes_;
};

/// Software::feed and Software::box_test of a design with set-up S.
template <class S>
std::unique_ptr<SceneFeed> set_up_feed(const rtl::Format& format, const ref::Bvh& bvh) {
  return std::make_unique<SetUpScene<S>>(format, bvh);
}
template <class S>
std::unique_ptr<BoxTest> set_up_test(const rtl::Design& design, const rtl::Format& format) {
  return std::make_unique<SetUpTest<S>>(design, format);
}

}  // namespace hitpipe::sim
