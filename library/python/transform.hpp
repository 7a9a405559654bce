// A transform as Python has it: a dict of offset and scale.
#pragma once

#include <algorithm>
#include <array>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "hitpipe/ref.hpp"
#include "library/python/arrays.hpp"

namespace hitpipe::python {

[[nodiscard]] inline Transform transform_of(const py::object& given) {
  try {
    if (py::isinstance<py::dict>(given) && given.contains("offset") && given.contains("scale")) {
      Transform transform{};
      const auto offset = given["offset"].cast<std::array<double, 3>>();
      std::copy(offset.begin(), offset.end(), transform.offset);
      transform.scale = given["scale"].cast<double>();
      return transform;
    }
  } catch (const py::cast_error&) {
    PyErr_Clear();
  }
  throw Refusal("transform: a dict of offset, three numbers, and scale is needed, as hitpipe.fit() gives it");
}

[[nodiscard]] inline py::dict dict_of(const Transform& transform) {
  py::dict made;
  made["offset"] = std::array<double, 3>{transform.offset[0], transform.offset[1], transform.offset[2]};
  made["scale"] = transform.scale;
  return made;
}

}  // namespace hitpipe::python
