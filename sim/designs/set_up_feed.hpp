// What all feeds share: rays in slots, boxes by node, and operands in port order. A set-up S of a design is
// constructed once for each ray, as S(ray, format). It has
//   S::Bits, S::Operands                   the operands of the design's pipeline, as Operands<Words, Bits>
//   fill(length, operands)                 sets all operands but the box; the ray is cut at `length`
//   S::Box, S::boxes(aabbs, format, out)   boxes as the design reads them: min and max of three axes, and
//                                          `others` for the ports of Role::other, where these are the box's
//   S::meet(ray, aabbs, format, out)       may be missing: what is true in a world of integers; false in a
//                                          format of the float world
// Fields are named, so the order of the ports is said by Operands::for_each alone.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

#include "hls/num/fp.hpp"
#include "host/format.hpp"
#include "sim/software/box_software.hpp"
#include "sim/software/feed.hpp"

namespace hitpipe::sim {

/// The value domain of a set-up: every number is a word.
struct Words {
  using sint = std::int64_t;
  using uint = std::int64_t;
  using bit = std::int64_t;
};

inline void put(std::int64_t number, std::int64_t& field) {
  field = number;
}
template <class F>
void put(std::int64_t pattern, hls::Fp<Words, F>& field) {
  field.bits = pattern;
}
/// Three components to the fields of three axes.
template <class Vector, class Field>
void put(const Vector& v, Field& x, Field& y, Field& z) {
  put(v[0], x);
  put(v[1], y);
  put(v[2], z);
}

/// Where the ports of a design stand.
template <class Operands, class Bits>
class PortOrder {
 public:
  explicit PortOrder(const Bits& bits) : bits_(bits) {
    const Operands none{};
    Operands::for_each(bits_, none, [&](const hls::Operand& port, const auto& /*field*/) {
      const auto axis = static_cast<std::size_t>(port.axis) - static_cast<std::size_t>(hls::Axis::x);
      if (port.role == hls::Role::plane_low) min_.at(axis) = count_;
      if (port.role == hls::Role::plane_high) max_.at(axis) = count_;
      if (port.role == hls::Role::other) others_.push_back(count_);
      ++count_;
    });
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  /// All operands.
  void write(const Operands& operands, std::int64_t* out) const {
    const auto visit = [&out](const hls::Operand& /*port*/, const auto& field) {
      if constexpr (std::same_as<std::decay_t<decltype(field)>, std::int64_t>) {
        *out++ = field;
      } else {
        *out++ = field.bits;
      }
    };
    Operands::for_each(bits_, operands, visit);
  }
  /// A box among operands that are written.
  template <class Box>
  void write_box(const Box& box, std::int64_t* out) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out[min_[axis]] = box.min[axis];
      out[max_[axis]] = box.max[axis];
    }
    if constexpr (requires { box.others; }) {
      for (std::size_t i = 0; i < others_.size(); ++i) out[others_[i]] = box.others.at(i);
    }
  }

 private:
  Bits bits_;
  std::size_t count_ = 0;
  std::array<std::size_t, 3> min_{}, max_{};
  std::vector<std::size_t> others_;
};

template <class S>
using PortOrderOf = PortOrder<typename S::Operands, typename S::Bits>;

template <class S>
class SetupRays final : public RayFeed {
 public:
  SetupRays(const std::vector<typename S::Box>& boxes, const Format& format, std::size_t slots)
      : boxes_(boxes),
        format_(format),
        ports_(format.as<typename S::Bits>()),
        slots_(slots, Slot{S({glm::vec3(0), glm::vec3(1), ref::Ray::infinite}, format), 0}),
        words_(slots * ports_.count()) {}

  void start(std::size_t slot, const ref::Ray& ray) override {
    slots_[slot].set_up = S(ray, format_);
    cut(slot, ray.length);
  }

  void operands(std::size_t slot, const Question& asked, std::int64_t* out) override {
    if (slots_[slot].length != asked.length) cut(slot, asked.length);
    std::copy_n(words(slot), ports_.count(), out);
    ports_.write_box(boxes_[asked.record], out);
  }

 private:
  struct Slot {
    S set_up;
    float length;
  };

  [[nodiscard]] std::int64_t* words(std::size_t slot) { return words_.data() + slot * ports_.count(); }
  /// A ray's length changes only when a closer hit is found.
  void cut(std::size_t slot, float length) {
    typename S::Operands operands{};
    slots_[slot].length = length;
    slots_[slot].set_up.fill(length, operands);
    ports_.write(operands, words(slot));
  }

  const std::vector<typename S::Box>& boxes_;
  Format format_;
  PortOrderOf<S> ports_;
  std::vector<Slot> slots_;
  std::vector<std::int64_t> words_;  ///< by slot: its operands, without a box
};

template <class S>
class SetupScene final : public SceneFeed {
 public:
  SetupScene(const Format& format, const ref::Bvh& bvh) : format_(format) {
    std::vector<ref::Aabb> boxes;
    boxes.reserve(bvh.nodes.size());
    for (const ref::BvhNode& node : bvh.nodes) boxes.push_back(node.box);
    boxes_.resize(boxes.size());
    S::boxes(boxes, format, boxes_);
  }
  [[nodiscard]] std::unique_ptr<RayFeed> unit(std::size_t slots) const override {
    return std::make_unique<SetupRays<S>>(boxes_, format_, slots);
  }

 private:
  Format format_;
  std::vector<typename S::Box> boxes_;
};

/// One ray at a time against given boxes.
template <class S>
class SetupTest final : public BoxTest {
 public:
  SetupTest(const rtl::Design& design, const Format& format)
      : evaluate_(design.evaluate(format)),
        format_(format),
        ports_(format.as<typename S::Bits>()),
        operands_(ports_.count()),
        results_(evaluate_.result_count()) {}

  void start(const ref::Ray& ray) override {
    typename S::Operands operands{};
    S(ray, format_).fill(ray.length, operands);
    ports_.write(operands, operands_.data());
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
      ports_.write_box(boxes_[i], operands_.data());
      evaluate_(operands_.data(), results_.data());
      out[i] = evaluate_.hit(results_.data());
    }
  }
  void meet(const ref::Ray& ray, std::span<const ref::Aabb> boxes, std::span<bool> out) const override {
    if constexpr (requires { S::meet(ray, boxes, format_, out); }) {
      if (S::meet(ray, boxes, format_, out)) return;
    }
    BoxTest::meet(ray, boxes, out);
  }
  [[nodiscard]] std::span<const std::int64_t> operands() const override { return operands_; }
  [[nodiscard]] std::span<const std::int64_t> results() const override { return results_; }

 private:
  rtl::Evaluate evaluate_;
  Format format_;
  PortOrderOf<S> ports_;
  std::vector<std::int64_t> operands_;
  std::vector<std::int64_t> results_;
  std::vector<typename S::Box> boxes_;
};

/// Software::feed and Software::box_test of a design with set-up S.
template <class S>
std::unique_ptr<SceneFeed> set_up_feed(const Format& format, const ref::Bvh& bvh) {
  return std::make_unique<SetupScene<S>>(format, bvh);
}
template <class S>
std::unique_ptr<BoxTest> set_up_test(const rtl::Design& design, const Format& format) {
  return std::make_unique<SetupTest<S>>(design, format);
}

}  // namespace hitpipe::sim
