// `import hitpipe`: hitpipe::ref for arrays of numpy.
#include "library/python/module.hpp"

#include "hitpipe/ref.hpp"
#include "library/python/arrays.hpp"
#include "library/python/working.hpp"

namespace hitpipe::python {

namespace {

constexpr const char* about =
    R"(hitpipe's ray-box units, and scenes with exact answers, for arrays of numpy.

Rays are an array (N, 7) of float32: origin, direction and length; or an array (N,) of hitpipe.rays_dtype. Boxes
are an array (N, 2, 3) of float32, the least and the largest corner; or an array (N,) of hitpipe.boxes_dtype.
Of a unit both are in the cube [-1, 1], and of a hitpipe.Scene in units of its own. A ray without an end has length
inf. What is wrong with an argument is said by
hitpipe.Error, a ValueError of one line. No number is converted:
float64 is refused; hitpipe.rounded_outward() and hitpipe.to_cube() round it.)";

py::array_t<bool> exact(const py::object& rays, const py::object& boxes) {
  const auto own_rays = rays_of(rays);
  const auto own_boxes = boxes_of(boxes, own_rays.count, 1);
  py::array_t<bool> met(static_cast<py::ssize_t>(own_rays.count));
  auto* const out = reinterpret_cast<std::uint8_t*>(met.mutable_data());
  const Working others_run;
  check(hitpipe_exact_pairs(own_rays.first, own_boxes.first, own_rays.count, out));
  return met;
}

}  // namespace

}  // namespace hitpipe::python

PYBIND11_MODULE(hitpipe, m) {
  using namespace hitpipe::python;  // NOLINT(google-build-using-namespace): the macro opens no namespace
  m.doc() = about;
  m.attr("__version__") = hitpipe_version();

  static py::exception<hitpipe::Error> error(m, "Error", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const hitpipe::Error& refused) {
      // What a signal's handler raised is there.
      if (PyErr_Occurred() == nullptr) error(refused.what());
    } catch (const std::invalid_argument& refused) {
      error(refused.what());
    } catch (const Refusal& refused) {
      error(refused.what());
    }
  });

  PYBIND11_NUMPY_DTYPE(hitpipe_ray, origin, direction, length);
  PYBIND11_NUMPY_DTYPE(hitpipe_box, min, max);
  m.attr("rays_dtype") = rays_dtype();
  m.attr("boxes_dtype") = boxes_dtype();
  m.def("exact", exact, py::arg("rays"), py::arg("boxes"),
        "Whether each ray and its box have a point in common, by exact arithmetic: an array (N,) of bool.");
  add_catalogue(m);
  add_cube(m);
  add_unit(m);
  add_scene(m);
}
