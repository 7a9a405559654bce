// The parts of the Python module.
#pragma once

#include <pybind11/pybind11.h>

namespace hitpipe::python {

/// Designs, formats and prices.
void add_catalogue(pybind11::module_& module);
/// Unit, its ports and its answers.
void add_unit(pybind11::module_& module);
/// Boxes and rays into the cube.
void add_cube(pybind11::module_& module);
/// Scene and its answers.
void add_scene(pybind11::module_& module);

}  // namespace hitpipe::python
