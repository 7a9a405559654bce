// From a scene's own units into the cube: boxes rounded outward, rays to nearest.
#include <string>

#include <pybind11/stl.h>

#include "hitpipe/ref.hpp"
#include "library/python/arrays.hpp"
#include "library/python/module.hpp"
#include "library/python/transform.hpp"

namespace hitpipe::python {

namespace {

static_assert(sizeof(hitpipe_bounds) == 6 * sizeof(double), "rows of doubles are bounds");

/// Throws a Refusal that names the item by its index, with what the C interface says of one.
void check_item(hitpipe_status status, const char* what, std::size_t i) {
  if (status == HITPIPE_OK) return;
  const std::string line = hitpipe_error();
  throw Refusal(what + (" " + std::to_string(i)) + line.substr(std::min(line.find(": "), line.size())));
}

py::array_t<float> moved_boxes(const Transform* transform, const py::array& given) {
  const auto own = doubles_of(given, "boxes", {2, 3});
  py::array_t<float> made({static_cast<py::ssize_t>(own.count), py::ssize_t{2}, py::ssize_t{3}});
  const auto* const boxes = reinterpret_cast<const hitpipe_bounds*>(own.first);
  auto* const out = reinterpret_cast<hitpipe_box*>(made.mutable_data());
  for (std::size_t i = 0; i < own.count; ++i)
    check_item(hitpipe_to_cube_box(transform, boxes + i, out + i), "box", i);
  return made;
}

py::array_t<float> moved_rays(const Transform* transform, const py::array& given) {
  const auto own = doubles_of(given, "rays", {7});
  py::array_t<float> made({static_cast<py::ssize_t>(own.count), py::ssize_t{7}});
  auto* const out = reinterpret_cast<hitpipe_ray*>(made.mutable_data());
  for (std::size_t i = 0; i < own.count; ++i) {
    const double* const ray = own.first + 7 * i;
    check_item(hitpipe_to_cube_ray(transform, ray, ray + 3, ray[6], out + i), "ray", i);
  }
  return made;
}

}  // namespace

void add_cube(py::module_& m) {
  m.def(
      "fit",
      [](const py::array& bounds) {
        const auto own = doubles_of(bounds, "bounds", {3});
        if (own.count != 2)
          throw Refusal("bounds: " + std::to_string(own.count) + " rows; allowed is (2, 3)");
        Transform transform{};
        check(hitpipe_fit(reinterpret_cast<const hitpipe_bounds*>(own.first), &transform));
        return dict_of(transform);
      },
      py::arg("bounds"),
      "The transform of a scene within these bounds, (2, 3) of float64, into the cube: a dict of offset and "
      "scale.");
  m.def(
      "to_cube",
      [](const py::object& transform, const py::array& items) {
        const Transform own = transform_of(transform);
        return items.ndim() == 2 ? moved_rays(&own, items) : moved_boxes(&own, items);
      },
      py::arg("transform"), py::arg("items"),
      "Boxes (N, 2, 3) or rays (N, 7) of float64, moved and rounded to float32: boxes outward, so that a ray "
      "which\n"
      "meets the moved box meets the rounded one; rays to nearest, with the length scaled.");
  m.def(
      "rounded_outward", [](const py::array& boxes) { return moved_boxes(nullptr, boxes); }, py::arg("boxes"),
      "Boxes of the cube, (N, 2, 3) of float64, rounded outward to float32.");
}

}  // namespace hitpipe::python
