// Scenes and what rays find in them.
#include "hitpipe/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "library/python/arrays.hpp"
#include "library/python/module.hpp"
#include "library/python/transform.hpp"
#include "library/python/working.hpp"

namespace hitpipe::python {

namespace {

/// A copy.
template <class To, class T>
py::array_t<To> array_of(const std::vector<T>& numbers) {
  static_assert(sizeof(To) == sizeof(T));
  return py::array_t<To>(static_cast<py::ssize_t>(numbers.size()),
                         reinterpret_cast<const To*>(numbers.data()));
}

/// A property whose array looks into an answer and keeps it alive.
template <class Answer, class T>
auto looks_into(std::vector<T> Answer::*numbers) {
  return [numbers](const py::object& answer) {
    const std::vector<T>& all = answer.cast<const Answer&>().*numbers;
    return py::array_t<T>(static_cast<py::ssize_t>(all.size()), all.data(), answer);
  };
}
/// None if they were not asked for.
py::object weights_of(const py::object& nearest) {
  const auto& of = nearest.cast<const Nearest&>();
  if (of.weights.empty() && !of.triangle.empty()) return py::none();
  return py::array_t<double>({static_cast<py::ssize_t>(of.weights.size()), py::ssize_t{3}},
                             of.weights.empty() ? nullptr : of.weights.front().data(), nearest);
}

/// Python's threads may share it, as they may the scene of C.
class PythonScene {
 public:
  PythonScene(const py::object& corners, const py::object& triangles, const std::string& world,
              const py::object& transform, const py::object& nodes, const py::object& order,
              const py::object& contains, int threads) {
    const auto points = rows_of<float>(corners, "corners", 3);
    const auto indices = rows_of<std::uint32_t>(triangles, "triangles", 3);
    corner_count_ = points.count;
    SceneOptions options{.world = world, .threads = threads};
    Transform own_transform{};
    if (!transform.is_none()) {
      own_transform = transform_of(transform);
      options.transform = &own_transform;
    }
    if (nodes.is_none() != order.is_none())
      throw Refusal("nodes and order: a hierarchy of your own has both");
    std::optional<Items<hitpipe_node>> own_nodes;
    std::optional<Items<std::uint32_t>> own_order;
    if (!nodes.is_none()) {
      own_nodes = nodes_of(nodes);
      own_order = numbers_of(order, "order", indices.count);
      options.nodes = {own_nodes->first, own_nodes->count};
      options.order = {own_order->first, own_order->count};
    }
    std::optional<Items<float>> own_contains;
    if (!contains.is_none()) {
      own_contains = rows_of<float>(contains, "contains", 3);
      options.contains = rows<Point>(*own_contains);
    }
    const Working others_run;
    own_.emplace(rows<Point>(points), rows<TriangleCorners>(indices), options);
  }

  /// `meshes` are pairs of corners and triangles.
  static PythonScene of_instances(const py::sequence& meshes, const py::object& instances,
                                  const std::string& world, const py::object& transform,
                                  const py::object& contains, int threads) {
    std::vector<Items<float>> points;
    std::vector<Items<std::uint32_t>> indices;
    std::vector<InstanceMesh> own_meshes;
    for (const py::handle& mesh : meshes) {
      const auto pair = py::cast<py::sequence>(mesh);
      if (pair.size() != 2) throw Refusal("meshes: each is a pair of corners and triangles");
      points.push_back(rows_of<float>(pair[0], "corners", 3));
      indices.push_back(rows_of<std::uint32_t>(pair[1], "triangles", 3));
      own_meshes.push_back({rows<Point>(points.back()), rows<TriangleCorners>(indices.back())});
    }
    const auto own_instances = instances_of(instances);
    SceneOptions options{.world = world, .threads = threads};
    Transform own_transform{};
    if (!transform.is_none()) {
      own_transform = transform_of(transform);
      options.transform = &own_transform;
    }
    std::optional<Items<float>> own_contains;
    if (!contains.is_none()) {
      own_contains = rows_of<float>(contains, "contains", 3);
      options.contains = rows<Point>(*own_contains);
    }
    const Working others_run;
    return PythonScene(Scene::of_instances(own_meshes, {own_instances.first, own_instances.count}, options));
  }

  [[nodiscard]] SceneInfo info() const {
    const Working others_run;
    return own_->info();
  }
  void place(std::size_t first, const py::object& matrices, int threads) {
    const py::array array = py::array::ensure(matrices);
    if (!array) throw Refusal("matrices: no array");
    const auto own = doubles_of(array, "matrices", {3, 4});
    const Working others_run;
    own_->place(first, {reinterpret_cast<const Matrix*>(own.first), own.count}, threads);
  }
  [[nodiscard]] PythonScene masked(std::uint8_t mask) const { return PythonScene(own_->masked(mask)); }
  [[nodiscard]] py::array_t<hitpipe_part> parts(const py::object& triangles) const {
    const auto own = numbers_of(triangles, "triangles", py::len(triangles));
    return array_of<hitpipe_part>(own_->parts({own.first, own.count}));
  }
  void move(const py::object& corners, int threads) {
    const auto points = rows_of<float>(corners, "corners", 3);
    if (points.count != corner_count_)
      throw Refusal("corners: " + std::to_string(points.count) + " of them; the scene has " +
                    std::to_string(corner_count_));
    const Working others_run;
    if (points.count != 0) check(hitpipe_scene_move(own_->handle(), points.first, threads));
  }

  /// What hitpipe::Scene answers to a question about these rays.
  template <class Answer, class... Choices>
  [[nodiscard]] Answer of_rays(Answer (Scene::*question)(std::span<const Ray>, Choices...) const,
                               const py::object& rays, Choices... choices) const {
    const auto own = rays_of(rays);
    const Working others_run;
    return ((*own_).*question)({own.first, own.count}, choices...);
  }
  [[nodiscard]] Nearest nearest(const py::object& rays, bool weights, int threads) const {
    return of_rays(&Scene::nearest, rays, weights, threads);
  }
  [[nodiscard]] py::array_t<bool> any(const py::object& rays, int threads) const {
    return array_of<bool>(of_rays(&Scene::any, rays, threads));
  }
  [[nodiscard]] Counts count(const py::object& rays, int threads) const {
    return of_rays(&Scene::count, rays, threads);
  }
  [[nodiscard]] Crossings all(const py::object& rays, int threads) const {
    return of_rays(&Scene::all, rays, threads);
  }
  [[nodiscard]] py::array_t<hitpipe_integer_ray> integer_rays(const py::object& rays) const {
    return array_of<IntegerRay>(of_rays(&Scene::integer_rays, rays));
  }
  [[nodiscard]] py::array_t<bool> inside(const py::object& points, int threads) const {
    const auto own = rows_of<float>(points, "points", 3);
    std::vector<std::uint8_t> in;
    {
      const Working others_run;
      in = own_->inside(rows<Point>(own), threads);
    }
    return array_of<bool>(in);
  }
  [[nodiscard]] py::bytes core_image() const {
    std::vector<std::uint8_t> bytes;
    {
      const Working others_run;
      bytes = own_->core_image();
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

 private:
  explicit PythonScene(Scene&& own) : own_(std::move(own)) {}

  template <class Row, class T>
  static std::span<const Row> rows(const Items<T>& items) {
    static_assert(sizeof(Row) == 3 * sizeof(T));
    return {reinterpret_cast<const Row*>(items.first), items.count};
  }

  std::optional<Scene> own_;
  std::size_t corner_count_ = 0;
};

}  // namespace

void add_scene(py::module_& m) {
  PYBIND11_NUMPY_DTYPE(hitpipe_node, first, count);
  PYBIND11_NUMPY_DTYPE(hitpipe_integer_ray, origin, direction, negative, major, length);
  PYBIND11_NUMPY_DTYPE(hitpipe_instance, mesh, number, matrix, mask);
  PYBIND11_NUMPY_DTYPE(hitpipe_part, instance, number, mesh, triangle);
  m.attr("instances_dtype") = py::dtype::of<hitpipe_instance>();
  m.attr("parts_dtype") = py::dtype::of<hitpipe_part>();
  m.attr("nodes_dtype") = py::dtype::of<hitpipe_node>();
  m.attr("integer_rays_dtype") = py::dtype::of<hitpipe_integer_ray>();
  m.attr("no_triangle") = py::int_(HITPIPE_NO_TRIANGLE);
  py::class_<Nearest>(m, "Nearest", "What Scene.nearest() gives.")
      .def_property_readonly("triangle", looks_into(&Nearest::triangle),
                             "uint32, (N,): its number, or hitpipe.no_triangle.")
      .def_property_readonly("t", looks_into(&Nearest::t),
                             "float64, (N,), in units of the ray's direction; inf: no hit.")
      .def_property_readonly("weights", weights_of, "float64, (N, 3), of the triangle's corners; or None.");
  py::class_<Counts>(m, "Counts", "What Scene.count() gives.")
      .def_property_readonly("crossings", looks_into(&Counts::crossings), "uint32, (N,).")
      .def_property_readonly("sides", looks_into(&Counts::sides),
                             "int32, (N,): 1 for each way out, -1 for each way in.");
  py::class_<Crossings>(m, "Crossings",
                        "What Scene.all() gives: those of ray i are at offsets[i] to offsets[i + 1] - 1.")
      .def_property_readonly("offsets", looks_into(&Crossings::offsets), "uint64, (N + 1,).")
      .def_property_readonly("triangle", looks_into(&Crossings::triangle), "uint32, (offsets[N],).")
      .def_property_readonly("t", looks_into(&Crossings::t), "float64, likewise; from near to far.")
      .def_property_readonly("side", looks_into(&Crossings::side),
                             "int8, likewise; 1: the way out, -1: the way in.");
  py::class_<SceneInfo>(m, "SceneInfo", "What Scene.info tells.")
      .def_property_readonly("world", [](const SceneInfo& info) { return std::string(info.world); })
      .def_readonly("triangles", &SceneInfo::triangles)
      .def_readonly("without_area", &SceneInfo::without_area, "Triangles that are never hit.")
      .def_property_readonly("closed", [](const SceneInfo& info) { return info.closed != 0; })
      .def_property_readonly("oriented", [](const SceneInfo& info) { return info.oriented != 0; })
      .def_readonly("odd_edges", &SceneInfo::odd_edges, "Edges with an odd number of triangles.")
      .def_property_readonly(
          "transform", [](const SceneInfo& info) { return dict_of(info.transform); },
          "A dict of offset and scale: from the mesh's units into the cube of an integer world.");
  py::class_<PythonScene>(
      m, "Scene",
      "Triangles that rays are asked about, as <hitpipe/scene.h> says. Corners are (C, "
      "3) of float32, triangles\n"
      "(T, 3) of uint32. `world` is \"float\", or an integer world: \"20+1s20\". "
      "`transform` is a dict of offset and\n"
      "scale, for an integer world; without it the cube holds the mesh, and the points `contains`, "
      "(P, 3) of float32, such\n"
      "as where rays begin. `nodes` and `order` are a hierarchy of your own. Threads may share a scene, "
      "and move it.\n"
      "`threads` of a call: 0 is one for each core.")
      .def(py::init<const py::object&, const py::object&, const std::string&, const py::object&,
                    const py::object&, const py::object&, const py::object&, int>(),
           py::arg("corners"), py::arg("triangles"), py::arg("world") = "float", py::kw_only(),
           py::arg("transform") = py::none(), py::arg("nodes") = py::none(), py::arg("order") = py::none(),
           py::arg("contains") = py::none(), py::arg("threads") = 0)
      .def_static(
          "of_instances", &PythonScene::of_instances, py::arg("meshes"), py::arg("instances"),
          py::arg("world"), py::kw_only(), py::arg("transform") = py::none(),
          py::arg("contains") = py::none(), py::arg("threads") = 0,
          "Meshes in many places, in an integer world. `meshes` are pairs of corners and triangles;\n"
          "`instances` is an array of hitpipe.instances_dtype, (I,): mesh, a number of yours, matrix of\n"
          "three rows of four, mask. Answers are those of one mesh with all triangles of all instances.")
      .def("place", &PythonScene::place, py::arg("first"), py::arg("matrices"), py::kw_only(),
           py::arg("threads") = 0, "New matrices, (N, 3, 4) of float64, for the instances from `first` on.")
      .def("masked", &PythonScene::masked, py::arg("mask"),
           "The same scene for rays with this mask: they see instances that have a bit of it.")
      .def("parts", &PythonScene::parts, py::arg("triangles"),
           "What triangles of answers are: hitpipe.parts_dtype, (N,).")
      .def_property_readonly("info", &PythonScene::info, "A hitpipe.SceneInfo.", py::keep_alive<0, 1>())
      .def("move", &PythonScene::move, py::arg("corners"), py::kw_only(), py::arg("threads") = 0,
           "New places for all corners; the triangles stay.")
      .def("nearest", &PythonScene::nearest, py::arg("rays"), py::kw_only(), py::arg("weights") = true,
           py::arg("threads") = 0, "The nearest hit of each ray: hitpipe.Nearest.")
      .def("any", &PythonScene::any, py::arg("rays"), py::kw_only(), py::arg("threads") = 0,
           "Whether each ray hits a triangle: bool, (N,).")
      .def("count", &PythonScene::count, py::arg("rays"), py::kw_only(), py::arg("threads") = 0,
           "How often each ray crosses the mesh, each surface once: hitpipe.Counts.")
      .def("all", &PythonScene::all, py::arg("rays"), py::kw_only(), py::arg("threads") = 0,
           "All crossings of each ray: hitpipe.Crossings.")
      .def("inside", &PythonScene::inside, py::arg("points"), py::kw_only(), py::arg("threads") = 0,
           "Whether each point, (P, 3) of float32, is inside the closed mesh: bool, (P,). Inside is the\n"
           "even-odd rule: a ray from there crosses the mesh an odd number of times. So what two\n"
           "overlapping solids share is not inside. Of an oriented mesh, count().sides of rays without an\n"
           "end are winding numbers: where no solid is turned, `!= 0` tells what is in any of them.")
      .def("integer_rays", &PythonScene::integer_rays, py::arg("rays"),
           "Rays as the traversal core's integer door takes them: hitpipe.integer_rays_dtype, (N,).")
      .def("core_image", &PythonScene::core_image, "The bytes that the traversal core reads from memory.");
}

}  // namespace hitpipe::python
