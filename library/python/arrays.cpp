#include "library/python/arrays.hpp"

#include <string>

namespace hitpipe::python {

namespace {

static_assert(sizeof(hitpipe_ray) == 7 * sizeof(float) && sizeof(hitpipe_box) == 6 * sizeof(float),
              "rows of floats are rays and boxes");

using Shape = std::vector<py::ssize_t>;

Shape shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

std::string shape_text(const Shape& shape) {
  return py::str(py::tuple(py::cast(shape))).cast<std::string>();
}

py::array array_of(const py::object& given, const std::string& what) {
  py::array array = py::array::ensure(given);
  if (!array) throw Refusal(what + ": no array");
  return array;
}

[[noreturn]] void refuse_type(const py::array& array, const std::string& what, const std::string& allowed) {
  throw Refusal(what + ": dtype is " + py::str(array.dtype()).cast<std::string>() + "; allowed is " +
                allowed);
}

/// Whether the items are structures; otherwise they are numbers, and a structure's numbers are in further
/// axes.
bool structured(const py::array& array, const std::string& what, const py::dtype& structure) {
  if (array.dtype().equal(structure)) return true;
  if (!array.dtype().equal(py::dtype::of<float>()))
    refuse_type(array, what, "float32, or hitpipe." + what + "_dtype");
  return false;
}

/// The array with its items one after another; copied only if they lie otherwise.
template <class T>
Items<T> items(const py::array& array, std::size_t count) {
  const py::array rows = py::array::ensure(array, py::array::c_style);
  if (!rows) throw std::bad_alloc();
  return {rows, static_cast<const T*>(rows.data()), count};
}

}  // namespace

Items<hitpipe_ray> rays_of(const py::object& given) {
  const py::array array = array_of(given, "rays");
  const bool structures = structured(array, "rays", rays_dtype());
  if (structures ? array.ndim() != 1 : array.ndim() != 2 || array.shape(1) != 7)
    throw Refusal("rays: shape is " + shape_text(shape_of(array)) + "; allowed is " +
                  (structures ? "(N,)" : "(N, 7)"));
  return items<hitpipe_ray>(array, static_cast<std::size_t>(array.shape(0)));
}

Items<hitpipe_box> boxes_of(const py::object& given, std::size_t tests, std::size_t per_test) {
  const py::array array = array_of(given, "boxes");
  Shape allowed{static_cast<py::ssize_t>(tests)};
  if (per_test != 1) allowed.push_back(static_cast<py::ssize_t>(per_test));
  if (!structured(array, "boxes", boxes_dtype())) allowed.insert(allowed.end(), {2, 3});
  if (shape_of(array) != allowed)
    throw Refusal("boxes: shape is " + shape_text(shape_of(array)) + "; allowed for " +
                  std::to_string(tests) + " rays is " + shape_text(allowed));
  return items<hitpipe_box>(array, tests * per_test);
}

template <class T>
Items<T> rows_of(const py::object& given, const std::string& what, std::size_t columns) {
  const py::array array = array_of(given, what);
  const py::dtype allowed = py::dtype::of<T>();
  if (!array.dtype().equal(allowed))
    refuse_type(array, what, py::str(py::handle(allowed)).cast<std::string>());
  if (array.ndim() != 2 || static_cast<std::size_t>(array.shape(1)) != columns)
    throw Refusal(what + ": shape is " + shape_text(shape_of(array)) + "; allowed is (N, " +
                  std::to_string(columns) + ")");
  return items<T>(array, static_cast<std::size_t>(array.shape(0)));
}
template Items<float> rows_of(const py::object&, const std::string&, std::size_t);
template Items<std::uint32_t> rows_of(const py::object&, const std::string&, std::size_t);

Items<std::int64_t> operands_of(const py::object& given, std::size_t ports) {
  return rows_of<std::int64_t>(given, "operands", ports);
}

Items<double> doubles_of(const py::array& array, const std::string& what, const Shape& columns) {
  if (!array.dtype().equal(py::dtype::of<double>())) refuse_type(array, what, "float64");
  Shape allowed = columns;
  allowed.insert(allowed.begin(), array.ndim() > 0 ? array.shape(0) : 0);
  if (shape_of(array) != allowed) {
    std::string text = "(N";
    for (const py::ssize_t length : columns) text += ", " + std::to_string(length);
    throw Refusal(what + ": shape is " + shape_text(shape_of(array)) + "; allowed is " + text + ")");
  }
  return items<double>(array, static_cast<std::size_t>(array.shape(0)));
}

Items<hitpipe_node> nodes_of(const py::object& given) {
  const py::array array = array_of(given, "nodes");
  if (!array.dtype().equal(py::dtype::of<hitpipe_node>()) || array.ndim() != 1)
    refuse_type(array, "nodes", "hitpipe.nodes_dtype, of shape (N,)");
  return items<hitpipe_node>(array, static_cast<std::size_t>(array.shape(0)));
}

Items<hitpipe_instance> instances_of(const py::object& given) {
  const py::array array = array_of(given, "instances");
  if (!array.dtype().equal(py::dtype::of<hitpipe_instance>()) || array.ndim() != 1)
    refuse_type(array, "instances", "hitpipe.instances_dtype, of shape (I,)");
  return items<hitpipe_instance>(array, static_cast<std::size_t>(array.shape(0)));
}

Items<std::uint32_t> numbers_of(const py::object& given, const std::string& what, std::size_t count) {
  const py::array array = array_of(given, what);
  if (!array.dtype().equal(py::dtype::of<std::uint32_t>())) refuse_type(array, what, "uint32");
  if (shape_of(array) != Shape{static_cast<py::ssize_t>(count)})
    throw Refusal(what + ": shape is " + shape_text(shape_of(array)) + "; allowed is (" +
                  std::to_string(count) + ",)");
  return items<std::uint32_t>(array, count);
}

}  // namespace hitpipe::python
