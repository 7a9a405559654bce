// The ray and its tests: operands, HIT and the exact answer.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "library/failure.hpp"
#include "library/shapes.hpp"
#include "library/unit.hpp"
#include "sw_ref/judge/box_referee.hpp"

namespace hitpipe::library {

namespace {

std::uint8_t flag(bool set) {
  return set ? 1 : 0;
}

std::int64_t* append(std::span<const std::int64_t> numbers, std::int64_t* out) {
  return out == nullptr ? nullptr : std::copy(numbers.begin(), numbers.end(), out);
}

/// `meets` says whether the ray meets a box.
template <class Meets>
void judge(const Meets& meets, const std::vector<ref::Aabb>& boxes, std::uint8_t* met) {
  for (const ref::Aabb& box : boxes) *met++ = flag(meets(box));
}

void run(sim::BoxTest& test, std::size_t boxes_per_test, const std::vector<ref::Aabb>& boxes,
         const hitpipe_answers& out) {
  std::uint8_t* hit = out.hit;
  std::int64_t* operands = out.operands;
  std::int64_t* results = out.results;
  for (std::size_t i = 0; i < boxes.size(); i += boxes_per_test) {
    const auto answers = boxes_per_test == 2 ? test.siblings(boxes[i], boxes[i + 1])
                                             : std::array<bool, 2>{test.hit(boxes[i]), false};
    if (hit != nullptr) {
      for (std::size_t box = 0; box < boxes_per_test; ++box) *hit++ = flag(answers[box]);
    }
    operands = append(test.operands(), operands);
    results = append(test.results(), results);
  }
}

}  // namespace
}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_exact(const hitpipe_ray* ray, const hitpipe_box* boxes, size_t box_count,
                             uint8_t* met) {
  return guarded([&] {
    const hitpipe::ref::BoxReferee referee(checked(given(ray, "ray")));
    const auto own = checked(given(boxes, box_count));
    judge([&](const auto& box) { return referee.meets(box); }, own, own.empty() ? met : &given(met, "met"));
  });
}

hitpipe_status hitpipe_set_ray(hitpipe_unit* unit, const hitpipe_ray* ray) {
  return guarded([&] {
    hitpipe_unit& its = given(unit, "unit");
    its.ray.reset();
    const hitpipe::ref::Ray own = checked(given(ray, "ray"));
    if (its.test == nullptr)
      throw Refusal(HITPIPE_BAD_ARGUMENT,
                    fmt::format("design {}: tests no boxes; give it operands", its.name));
    its.test->start(own);
    its.ray = own;
  });
}

hitpipe_status hitpipe_test(hitpipe_unit* unit, const hitpipe_box* boxes, size_t box_count,
                            const hitpipe_answers* out) {
  return guarded([&] {
    hitpipe_unit& its = given(unit, "unit");
    const hitpipe_answers& places = given(out, "out");
    if (!its.ray)
      throw Refusal(HITPIPE_NO_RAY, fmt::format("design {}: no ray is set; set one before a test", its.name));
    if (box_count % its.boxes_per_test != 0)
      throw Refusal(HITPIPE_BAD_ARGUMENT,
                    fmt::format("design {}: {} boxes; a test takes {}, so allowed are multiples of {}",
                                its.name, box_count, its.boxes_per_test, its.boxes_per_test));
    const auto own = checked(given(boxes, box_count));
    run(*its.test, its.boxes_per_test, own, places);
    if (places.exact != nullptr)
      judge([&](const auto& box) { return its.test->meets(*its.ray, box); }, own, places.exact);
  });
}

hitpipe_status hitpipe_run(const hitpipe_unit* unit, const int64_t* operands, size_t test_count,
                           int64_t* results) {
  return guarded([&] {
    const hitpipe_unit& its = given(unit, "unit");
    if (test_count == 0) return;
    const int64_t* const first = &given(operands, "operands");
    std::int64_t* out = &given(results, "results");
    for (std::size_t test = 0; test < test_count; ++test) {
      for (std::size_t i = 0; i < its.ports.size(); ++i) {
        const auto [low, high] = hitpipe::rtl::numbers_of(its.ports[i]);
        const std::int64_t value = first[test * its.ports.size() + i];
        if (value < low || value > high)
          throw Refusal(HITPIPE_BAD_OPERAND, fmt::format("test {}: operand {} is {}; allowed is {} to {}",
                                                         test, its.ports[i].name, value, low, high));
      }
    }
    for (std::size_t test = 0; test < test_count; ++test, out += its.results.size())
      its.evaluate(first + test * its.ports.size(), out);
  });
}

uint64_t hitpipe_bits(int64_t value, int width) {
  const auto bits = static_cast<std::uint64_t>(value);
  return width >= 64 ? bits : bits & ((std::uint64_t{1} << std::max(width, 0)) - 1);
}
