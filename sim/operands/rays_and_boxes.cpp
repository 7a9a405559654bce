#include "sim/operands/rays_and_boxes.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "host/text.hpp"
#include "rays/world/to_cube.hpp"

namespace hitpipe::sim {

namespace {

// Products of these with a scale neither overflow nor lose bits in a double.
constexpr double largest_number = 1e30;
constexpr double smallest_side = 1e-30;

void check(const ref::Bounds& bounds) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double bound : {bounds.min[axis], bounds.max[axis]})
      if (!(std::abs(bound) <= largest_number))
        throw std::runtime_error(fmt::format("bounds: {} is out of range; allowed is -1e30 to 1e30", bound));
    if (bounds.min[axis] > bounds.max[axis])
      throw std::runtime_error(fmt::format("bounds: min_{0} {1} is above max_{0} {2}", "xyz"[axis],
                                           bounds.min[axis], bounds.max[axis]));
  }
  if (!(bounds.longest() >= smallest_side))
    throw std::runtime_error(
        fmt::format("bounds: the longest side is {}; it must be at least 1e-30", bounds.longest()));
}

}  // namespace

Placement::Placement(const ref::Bounds& bounds) : has_bounds_(true) {
  check(bounds);
  transform_ = ref::fit_to_cube(bounds, {});
}

double Placement::place(double own, int axis) const {
  return has_bounds_ ? (own - transform_.offset[axis]) * transform_.scale : own;
}

float Placement::plane(double own, int axis, Rounding side) const {
  if (!has_bounds_) return to_binary32(own, 0.0, side);
  const double offset = transform_.offset[axis];
  return side == Rounding::up ? ref::plane_above(own, offset, transform_.scale)
                              : ref::plane_below(own, offset, transform_.scale);
}

namespace {

constexpr std::size_t ray_columns = 7;
constexpr std::size_t planes_of_box = 6;

double checked_number(const NumberFile& lines, const NumberLine& line, std::size_t column,
                      std::string_view word) {
  const std::optional<double> value = read_double(word);
  if (!value)
    lines.reject(line,
                 fmt::format("{} is \"{}\", which is no number; allowed are decimal numbers such as -0.25 "
                             "and C's hexadecimal numbers such as -0x1p-2",
                             lines.column(column), host::shortened(word)));
  return *value;
}

[[noreturn]] void outside(const NumberFile& lines, const NumberLine& line, std::size_t column, int axis,
                          std::string_view word, const Placement& placement) {
  const char* const where = placement.has_bounds() ? "beyond the bounds" : "outside the cube";
  const char* const how = placement.has_bounds() ? "" : "; for other units give the bounds of all boxes";
  lines.reject(line,
               fmt::format("{} {} lies {}; allowed is {:.9g} to {:.9g}{}", lines.column(column),
                           host::shortened(word), where, placement.least(axis), placement.most(axis), how));
}

bool is_infinity(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  return word == "inf" || word == "Inf" || word == "INF" || word == "infinity" || word == "Infinity";
}

}  // namespace

RayFile::RayFile(const std::string& file, const Placement& placement)
    : placement_(placement), lines_(file, {"ox", "oy", "oz", "dx", "dy", "dz"}, {"length"}) {}

double RayFile::number(const NumberLine& line, std::size_t column, std::string_view word) const {
  return checked_number(lines_, line, column, word);
}

float RayFile::length(const NumberLine& line, std::string_view word) const {
  if (word.empty() || is_infinity(word)) return ref::Ray::infinite;
  const double own = number(line, ray_columns - 1, word);
  if (own < 0)
    lines_.reject(line, fmt::format("length {} is negative; allowed is 0 or more, inf or nothing",
                                    host::shortened(word)));
  const float length =
      placement_.has_bounds() ? static_cast<float>(placement_.length(own)) : nearest_binary32(word);
  if (std::isinf(length))
    lines_.reject(line, fmt::format("length {} is beyond binary32; for a ray without an end write inf",
                                    host::shortened(word)));
  return length;
}

ref::Ray RayFile::ray(const NumberLine& line) const {
  std::array<std::string_view, ray_columns> words;
  lines_.words(line, words);
  ref::Ray ray;
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = static_cast<std::size_t>(axis);
    const double place = placement_.place(number(line, column, words[column]), axis);
    if (!(std::abs(place) <= 1.0)) outside(lines_, line, column, axis, words[column], placement_);
    ray.origin[axis] = placement_.has_bounds() ? static_cast<float>(place) : nearest_binary32(words[column]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = static_cast<std::size_t>(axis) + 3;
    static_cast<void>(number(line, column, words[column]));
    ray.direction[axis] = nearest_binary32(words[column]);
    if (std::isinf(ray.direction[axis]))
      lines_.reject(line,
                    fmt::format("{} {} is beyond binary32; a direction may have any length, so divide it",
                                lines_.column(column), host::shortened(words[column])));
  }
  if (ray.direction == glm::vec3(0.0F))
    lines_.reject(line, "the direction is (0, 0, 0) in binary32; one component must differ from 0");
  ray.length = length(line, words[ray_columns - 1]);
  return ray;
}

std::vector<std::string> box_columns(std::size_t boxes_per_line) {
  std::vector<std::string> names;
  for (std::size_t box = 0; box < boxes_per_line; ++box)
    for (const char* const side : {"min", "max"})
      for (const char axis : {'x', 'y', 'z'})
        names.push_back(boxes_per_line == 1 ? fmt::format("{}_{}", side, axis)
                                            : fmt::format("{}_{}_{}", side, axis, box));
  return names;
}

BoxFile::BoxFile(const std::string& file, const Placement& placement, std::size_t boxes_per_line)
    : placement_(placement), boxes_per_line_(boxes_per_line), lines_(file, box_columns(boxes_per_line)) {}

float BoxFile::plane(const NumberLine& line, std::size_t column, std::string_view word) const {
  const bool upper = column % planes_of_box >= 3;
  const Rounding outward = upper ? Rounding::up : Rounding::down;
  const auto axis = static_cast<int>(column % 3);
  const double own = read_double(word, outward);
  if (std::abs(placement_.place(own, axis)) <= 1.0) {
    const float rounded = placement_.plane(own, axis, outward);
    if (std::abs(rounded) <= 1.0F) return rounded;
  }
  outside(lines_, line, column, axis, word, placement_);
}

Boxes BoxFile::boxes(const NumberLine& line) const {
  std::array<std::string_view, 2 * planes_of_box> all;
  const std::span<std::string_view> words(all.data(), planes_of_box * boxes_per_line_);
  lines_.words(line, words);
  Boxes boxes;
  for (std::size_t box = 0; box < boxes_per_line_; ++box) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t low = planes_of_box * box + static_cast<std::size_t>(axis);
      const std::size_t high = low + 3;
      if (checked_number(lines_, line, low, words[low]) > checked_number(lines_, line, high, words[high]))
        lines_.reject(line,
                      fmt::format("{} {} is above {} {}", lines_.column(low), host::shortened(words[low]),
                                  lines_.column(high), host::shortened(words[high])));
      boxes[box].min[axis] = plane(line, low, words[low]);
      boxes[box].max[axis] = plane(line, high, words[high]);
    }
  }
  return boxes;
}

}  // namespace hitpipe::sim
