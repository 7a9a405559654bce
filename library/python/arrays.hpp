// Arrays of numpy as the C interface takes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "hitpipe/ref.h"
#include "hitpipe/scene.h"

namespace hitpipe::python {

namespace py = pybind11;

/// The line of a hitpipe.Error that does not come from the C interface.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Items one after another, and the array that keeps them.
template <class T>
struct Items {
  py::array owner;
  const T* first;
  std::size_t count;
};

/// The types of structured arrays: hitpipe.rays_dtype and hitpipe.boxes_dtype.
[[nodiscard]] inline py::dtype rays_dtype() {
  return py::dtype::of<hitpipe_ray>();
}
[[nodiscard]] inline py::dtype boxes_dtype() {
  return py::dtype::of<hitpipe_box>();
}

/// All throw a Refusal that says what is allowed. No number is converted, since float32 does not have
/// every number of another type.
[[nodiscard]] Items<hitpipe_ray> rays_of(const py::object& given);
/// Of so many tests, each with so many boxes.
[[nodiscard]] Items<hitpipe_box> boxes_of(const py::object& given, std::size_t tests, std::size_t per_test);
/// Rows with an operand for each port; the count is of rows.
[[nodiscard]] Items<std::int64_t> operands_of(const py::object& given, std::size_t ports);
/// Rows of so many numbers of type T; the count is of rows.
template <class T>
[[nodiscard]] Items<T> rows_of(const py::object& given, const std::string& what, std::size_t columns);
extern template Items<float> rows_of(const py::object&, const std::string&, std::size_t);
extern template Items<std::uint32_t> rows_of(const py::object&, const std::string&, std::size_t);
/// float64, of shape (N, ...) with these lengths behind N.
[[nodiscard]] Items<double> doubles_of(const py::array& given, const std::string& what,
                                       const std::vector<py::ssize_t>& columns);
/// hitpipe.nodes_dtype, one after the other.
[[nodiscard]] Items<hitpipe_node> nodes_of(const py::object& given);
/// hitpipe.instances_dtype, one after the other.
[[nodiscard]] Items<hitpipe_instance> instances_of(const py::object& given);
/// So many numbers.
[[nodiscard]] Items<std::uint32_t> numbers_of(const py::object& given, const std::string& what,
                                              std::size_t count);

}  // namespace hitpipe::python
