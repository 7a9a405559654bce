// The placing of a scene. The input is numbers separated by blanks: eye, target, up, field of view,
// projection (orthographic if it is more than 0), position and intensity of a point light, direction and
// intensity of a sun, then triangles of nine coordinates. Everything lies in the cube, under a camera with
// axes of length 1 at right angles, or one line says what is wrong.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "rays/exact/exact_triangle.hpp"
#include "rays/scene/scene.hpp"
#include "sw_ref/render/camera.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

class Numbers {
 public:
  explicit Numbers(const std::string& text) {
    const char* at = text.c_str();
    for (char* end = nullptr; numbers_.size() < most; at = end) {
      const double number = std::strtod(at, &end);
      if (end == at) break;
      numbers_.push_back(number);
    }
  }
  [[nodiscard]] std::size_t left() const { return numbers_.size() - at_; }
  double next() { return numbers_[at_++]; }
  glm::dvec3 vector() {
    glm::dvec3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = next();
    return v;
  }

 private:
  static constexpr std::size_t most = 1000;
  std::vector<double> numbers_;
  std::size_t at_ = 0;
};

/// The triangles with area and finite corners, as the reader of mesh files would keep them.
/// As a mesh file's coordinates must.
bool fits(double x) {
  return std::abs(x) <= double{std::numeric_limits<float>::max()};
}

ref::SourceMesh read_mesh(Numbers& numbers) {
  ref::SourceMesh mesh;
  while (numbers.left() >= 9) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    bool finite = true;
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 v(numbers.vector());
      finite = finite && fits(v.x) && fits(v.y) && fits(v.z);
      mesh.vertices.push_back(v);
    }
    const glm::uvec3 triangle(first, first + 1, first + 2);
    mesh.triangles.push_back(triangle);
    if (finite && ref::has_area(mesh.corners(static_cast<std::uint32_t>(mesh.triangles.size()) - 1)))
      continue;
    mesh.triangles.pop_back();
    mesh.vertices.resize(first);
  }
  return mesh;
}

bool in_cube(const glm::vec3& p) {
  constexpr auto bound = static_cast<float>(ref::cube_bound);
  return std::abs(p.x) <= bound && std::abs(p.y) <= bound && std::abs(p.z) <= bound;
}

void expect_placed(const ref::Scene& scene) {
  for (const glm::vec3& v : scene.mesh.vertices) expect(in_cube(v), "the mesh is in the cube");
  for (const ref::Light& light : scene.lights) {
    if (light.kind == ref::LightKind::sun)
      expect(std::abs(glm::length(glm::dvec3(light.position)) - 1.0) < 1e-6, "directions have length 1");
    else
      expect(in_cube(light.position), "lights are in the cube");
  }
  const ref::Camera& camera = scene.camera;
  expect(in_cube(camera.eye), "the eye is in the cube");
  constexpr double rounding = 1e-9;  // right angles are the cross products of a sine of 1e-6 at least
  const auto near = [](double value, double wanted) { return std::abs(value - wanted) <= rounding; };
  for (const glm::dvec3& axis : {camera.forward, camera.right, camera.up})
    expect(near(glm::length(axis), 1.0), "camera axes have length 1");
  expect(near(glm::dot(camera.forward, camera.right), 0.0) && near(glm::dot(camera.right, camera.up), 0.0) &&
             near(glm::dot(camera.up, camera.forward), 0.0),
         "camera axes are at right angles");
  expect(camera.tan_half_height > 0.0 && std::isfinite(camera.tan_half_height), "the view has a height");
  expect(camera.half_height > 0.0 && camera.half_height <= 0x1p20, "the orthographic image has a height");
  for (const int x : {0, 3, 7}) {
    const ref::Ray ray = ref::primary_ray(camera, x, x, 8, 8);
    for (int axis = 0; axis < 3; ++axis) expect(std::abs(ray.origin[axis]) <= 1.0F, "rays start in the cube");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Numbers numbers(std::string(reinterpret_cast<const char*>(data), size));
  constexpr std::size_t placing = 3 + 3 + 3 + 1 + 1 + 3 + 3 + 3 + 3;
  if (numbers.left() < placing) return 0;
  ref::SceneDescription scene;
  scene.name = "fuzz";
  scene.materials.resize(1);
  scene.eye = numbers.vector();
  scene.target = numbers.vector();
  scene.up = numbers.vector();
  scene.fov_degrees = numbers.next();
  scene.projection = numbers.next() > 0.0 ? ref::Projection::orthographic : ref::Projection::perspective;
  // In braces the numbers are read from left to right.
  scene.lights.push_back({numbers.vector(), numbers.vector()});
  scene.lights.push_back({numbers.vector(), numbers.vector(), ref::LightKind::sun});
  scene.mesh = read_mesh(numbers);
  if (scene.mesh.triangles.empty()) return 0;
  try {
    expect_placed(ref::place(std::move(scene)));
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
