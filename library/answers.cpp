// The ray and its tests: operands, HIT and the exact answer.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "library/failure.hpp"
#include "library/shapes.hpp"
#include "library/unit.hpp"
#include "rays/exact/box_referee.hpp"

namespace hitpipe::library {

namespace {

std::uint8_t flag(bool set) {
  return set ? 1 : 0;
}

std::int64_t* append(std::span<const std::int64_t> numbers, std::int64_t* out) {
  return out == nullptr ? nullptr : std::copy(numbers.begin(), numbers.end(), out);
}

/// Tests the started ray against the boxes of one test, and moves the places to those of the next one.
void answer(sim::BoxTest& test, std::span<const ref::Aabb> boxes, hitpipe_answers& next) {
  const auto answers =
      boxes.size() == 2 ? test.siblings(boxes[0], boxes[1]) : std::array<bool, 2>{test.hit(boxes[0]), false};
  if (next.hit != nullptr) {
    for (std::size_t box = 0; box < boxes.size(); ++box) *next.hit++ = flag(answers[box]);
  }
  next.operands = append(test.operands(), next.operands);
  next.results = append(test.results(), next.results);
}

/// Whether the ray meets each box; moves the place to that of the next box.
void judge(const sim::BoxTest& test, const ref::Ray& ray, std::span<const ref::Aabb> boxes,
           hitpipe_answers& next) {
  if (next.exact == nullptr) return;
  for (const ref::Aabb& box : boxes) *next.exact++ = flag(test.meets(ray, box));
}

/// The unit's own test. Throws a Refusal if the design tests no boxes.
sim::BoxTest& box_test(const hitpipe_unit& unit) {
  if (unit.test == nullptr)
    throw Refusal(HITPIPE_BAD_ARGUMENT,
                  fmt::format("design {}: tests no boxes; give it operands", unit.name));
  return *unit.test;
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
    if (own.empty()) return;
    std::uint8_t* const place = &given(met, "met");
    for (std::size_t i = 0; i < box_count; ++i) {
      hitpipe::host::look(i);
      place[i] = flag(referee.meets(own[i]));
    }
  });
}

hitpipe_status hitpipe_exact_pairs(const hitpipe_ray* rays, const hitpipe_box* boxes, size_t pair_count,
                                   uint8_t* met) {
  return guarded([&] {
    const auto own_rays = checked(given(rays, pair_count));
    const auto own_boxes = checked(given(boxes, pair_count));
    if (pair_count == 0) return;
    std::uint8_t* const place = &given(met, "met");
    for (std::size_t i = 0; i < pair_count; ++i) {
      hitpipe::host::look(i);
      place[i] = flag(hitpipe::ref::ray_meets_box(own_rays[i], own_boxes[i]));
    }
  });
}

hitpipe_status hitpipe_set_ray(hitpipe_unit* unit, const hitpipe_ray* ray) {
  return guarded([&] {
    hitpipe_unit& its = given(unit, "unit");
    its.ray.reset();
    const hitpipe::ref::Ray own = checked(given(ray, "ray"));
    box_test(its).start(own);
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
    hitpipe_answers next = places;
    for (std::size_t i = 0; i < own.size(); i += its.boxes_per_test) {
      const std::span boxes_of_test = std::span(own).subspan(i, its.boxes_per_test);
      answer(*its.test, boxes_of_test, next);
      judge(*its.test, *its.ray, boxes_of_test, next);
    }
  });
}

hitpipe_status hitpipe_test_pairs(hitpipe_unit* unit, const hitpipe_ray* rays, const hitpipe_box* boxes,
                                  size_t test_count, const hitpipe_answers* out) {
  return guarded([&] {
    hitpipe_unit& its = given(unit, "unit");
    hitpipe_answers next = given(out, "out");
    hitpipe::sim::BoxTest& test = box_test(its);
    if (test_count > SIZE_MAX / sizeof(hitpipe_box) / its.boxes_per_test) throw std::bad_alloc();
    const auto own_rays = checked(given(rays, test_count));
    const auto own_boxes = checked(given(boxes, test_count * its.boxes_per_test));
    its.ray.reset();
    for (std::size_t i = 0; i < test_count; ++i) {
      hitpipe::host::look(i);
      const std::span boxes_of_test =
          std::span(own_boxes).subspan(i * its.boxes_per_test, its.boxes_per_test);
      test.start(own_rays[i]);
      answer(test, boxes_of_test, next);
      judge(test, own_rays[i], boxes_of_test, next);
    }
  });
}

hitpipe_status hitpipe_test_operands(const hitpipe_unit* unit, const int64_t* operands, size_t test_count,
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
    for (std::size_t test = 0; test < test_count; ++test, out += its.results.size()) {
      hitpipe::host::look(test);
      its.evaluate(first + test * its.ports.size(), out);
    }
  });
}

uint64_t hitpipe_bits(int64_t value, int width) {
  const auto bits = static_cast<std::uint64_t>(value);
  return width >= 64 ? bits : bits & ((std::uint64_t{1} << std::max(width, 0)) - 1);
}
