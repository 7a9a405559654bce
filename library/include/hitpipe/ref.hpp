// <hitpipe/ref.h> for C++20: a unit that closes itself, vectors in place of pointers, exceptions of one line.
// What numbers mean, and the rules for threads, are there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <hitpipe/ref.h>

namespace hitpipe {

inline constexpr float endless = std::numeric_limits<float>::infinity();

using Ray = hitpipe_ray;
using Box = hitpipe_box;
using Bounds = hitpipe_bounds;
using Transform = hitpipe_transform;
using DesignInfo = hitpipe_design_info;
using PriceInfo = hitpipe_price_info;
using PortInfo = hitpipe_port_info;
using ResultInfo = hitpipe_result_info;

/// What a call of the C interface refused; what() is its line.
class Error : public std::runtime_error {
 public:
  explicit Error(hitpipe_status status) : std::runtime_error(hitpipe_error()), status_(status) {}
  [[nodiscard]] hitpipe_status status() const { return status_; }

 private:
  hitpipe_status status_;
};

inline void check(hitpipe_status status) {
  if (status != HITPIPE_OK) throw Error(status);
}

/// While it lives, long calls of this thread ask `stop` now and then. If it says so they throw an Error of
/// HITPIPE_STOPPED.
class StopWhen {
 public:
  explicit StopWhen(std::function<bool()> stop)
      : stop_(std::move(stop)),
        watch_{[](void* own) { return static_cast<StopWhen*>(own)->stop_() ? 1 : 0; }, this},
        before_(hitpipe_set_watch(&watch_)) {}
  ~StopWhen() { hitpipe_set_watch(before_); }
  StopWhen(const StopWhen&) = delete;
  StopWhen& operator=(const StopWhen&) = delete;

 private:
  std::function<bool()> stop_;
  hitpipe_watch watch_;
  const hitpipe_watch* before_;
};

[[nodiscard]] inline std::vector<DesignInfo> designs() {
  std::vector<DesignInfo> all(hitpipe_design_count());
  for (std::size_t i = 0; i < all.size(); ++i) check(hitpipe_design(i, &all[i]));
  return all;
}

/// Without `library` in the cells of the thesis.
[[nodiscard]] inline PriceInfo price(const std::string& design, const std::string& format = "",
                                     const std::string& library = "") {
  PriceInfo info;
  check(hitpipe_price(design.c_str(), format.c_str(), library.c_str(), &info));
  return info;
}

/// What a unit says of boxes. Tests are one after another, each with all its operands and all its results.
struct Answers {
  std::vector<std::uint8_t> hit;    ///< of each box
  std::vector<std::uint8_t> exact;  ///< of each box
  std::vector<std::int64_t> operands;
  std::vector<std::int64_t> results;
};

/// A design at a format. Threads must not share it.
class Unit {
 public:
  /// Without `format` in the default one.
  explicit Unit(const std::string& design, const std::string& format = "") : unit_(opened(design, format)) {
    for (std::size_t i = 0; i < hitpipe_port_count(unit_.get()); ++i)
      check(hitpipe_port(unit_.get(), i, &ports_.emplace_back()));
    for (std::size_t i = 0; i < hitpipe_result_count(unit_.get()); ++i)
      check(hitpipe_result(unit_.get(), i, &results_.emplace_back()));
  }

  /// For calls of the C interface; closed with this object.
  [[nodiscard]] hitpipe_unit* handle() const { return unit_.get(); }
  [[nodiscard]] std::string_view design() const { return hitpipe_unit_design(unit_.get()); }
  [[nodiscard]] std::string_view format() const { return hitpipe_unit_format(unit_.get()); }
  [[nodiscard]] bool conservative() const { return hitpipe_unit_conservative(unit_.get()) != 0; }
  [[nodiscard]] std::size_t boxes_per_test() const { return hitpipe_unit_boxes_per_test(unit_.get()); }
  [[nodiscard]] std::span<const PortInfo> ports() const { return ports_; }
  [[nodiscard]] std::span<const ResultInfo> results() const { return results_; }

  void set_ray(const Ray& ray) { check(hitpipe_set_ray(unit_.get(), &ray)); }

  /// All that hitpipe_test() gives for these boxes.
  [[nodiscard]] Answers test(std::span<const Box> boxes) {
    Answers all = answers_for(boxes.size());
    const hitpipe_answers out = places(all);
    check(hitpipe_test(unit_.get(), boxes.data(), boxes.size(), &out));
    return all;
  }
  [[nodiscard]] Answers test(const Box& box) { return test({&box, 1}); }

  /// All that hitpipe_test_pairs() gives for each ray and its box, or its two boxes.
  [[nodiscard]] Answers test_pairs(std::span<const Ray> rays, std::span<const Box> boxes) {
    if (boxes.size() != rays.size() * boxes_per_test())
      throw std::invalid_argument("test_pairs: " + std::to_string(rays.size()) + " rays and " +
                                  std::to_string(boxes.size()) + " boxes; a test has " +
                                  std::to_string(boxes_per_test()) + " for its ray");
    Answers all = answers_for(boxes.size());
    const hitpipe_answers out = places(all);
    check(hitpipe_test_pairs(unit_.get(), rays.data(), boxes.data(), rays.size(), &out));
    return all;
  }

  /// The operands of one test as the ports of the Verilog take them: cut to their widths.
  [[nodiscard]] std::vector<std::uint64_t> port_bits(std::span<const std::int64_t> operands) const {
    std::vector<std::uint64_t> bits;
    for (std::size_t i = 0; i < ports_.size(); ++i)
      bits.push_back(hitpipe_bits(operands[i], ports_[i].width));
    return bits;
  }

  /// What the unit answers to operands of your own: all results of each test, as hitpipe_test_operands()
  /// gives them.
  [[nodiscard]] std::vector<std::int64_t> test_operands(std::span<const std::int64_t> operands) const {
    if (operands.size() % ports_.size() != 0)
      throw std::invalid_argument("test_operands: a test has " + std::to_string(ports_.size()) + " operands");
    const std::size_t tests = operands.size() / ports_.size();
    std::vector<std::int64_t> results(tests * results_.size());
    check(hitpipe_test_operands(unit_.get(), operands.data(), tests, results.data()));
    return results;
  }

  /// HIT alone; `out` has as many places as `boxes`.
  void hits(std::span<const Box> boxes, std::span<std::uint8_t> out) {
    if (out.size() < boxes.size()) throw std::invalid_argument("hits: fewer places than boxes");
    const hitpipe_answers hits_only{out.data(), nullptr, nullptr, nullptr};
    check(hitpipe_test(unit_.get(), boxes.data(), boxes.size(), &hits_only));
  }

 private:
  struct Close {
    void operator()(hitpipe_unit* unit) const { hitpipe_close(unit); }
  };
  using Handle = std::unique_ptr<hitpipe_unit, Close>;

  static Handle opened(const std::string& design, const std::string& format) {
    hitpipe_unit* unit = nullptr;
    check(hitpipe_open(design.c_str(), format.c_str(), &unit));
    return Handle(unit);
  }

  [[nodiscard]] Answers answers_for(std::size_t boxes) const {
    const std::size_t tests = boxes / boxes_per_test();
    return {std::vector<std::uint8_t>(boxes), std::vector<std::uint8_t>(boxes),
            std::vector<std::int64_t>(tests * ports_.size()),
            std::vector<std::int64_t>(tests * results_.size())};
  }
  static hitpipe_answers places(Answers& all) {
    return {all.hit.data(), all.exact.data(), all.operands.data(), all.results.data()};
  }

  Handle unit_;
  std::vector<PortInfo> ports_;
  std::vector<ResultInfo> results_;
};

/// Whether ray and box have a point in common, by exact arithmetic.
[[nodiscard]] inline bool exact(const Ray& ray, const Box& box) {
  std::uint8_t met = 0;
  check(hitpipe_exact(&ray, &box, 1, &met));
  return met != 0;
}

/// The transform of a scene within these bounds into the cube.
[[nodiscard]] inline Transform fit(const Bounds& bounds) {
  Transform transform;
  check(hitpipe_fit(&bounds, &transform));
  return transform;
}

[[nodiscard]] inline Box to_cube(const Transform& transform, const Bounds& box) {
  Box moved;
  check(hitpipe_to_cube_box(&transform, &box, &moved));
  return moved;
}

/// A box that is in the cube, rounded outward.
[[nodiscard]] inline Box rounded_outward(const Bounds& box) {
  Box rounded;
  check(hitpipe_to_cube_box(nullptr, &box, &rounded));
  return rounded;
}

[[nodiscard]] inline Ray to_cube(const Transform& transform, std::span<const double, 3> origin,
                                 std::span<const double, 3> direction, double length = endless) {
  Ray moved;
  check(hitpipe_to_cube_ray(&transform, origin.data(), direction.data(), length, &moved));
  return moved;
}

}  // namespace hitpipe
