#include <span>
#include <type_traits>

#include <fmt/format.h>

#include "host/text.hpp"
#include "sim/sweep/rows_file.hpp"
#include "sim/sweep/sweep.hpp"

namespace hitpipe::sim {

namespace {

class Hash {
 public:
  /// Hashes numbers, or structs of numbers of one type without gaps.
  template <class Value>
  Hash& operator<<(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    hash_ = host::fnv1a(std::as_bytes(std::span(&value, 1)), hash_);
    return *this;
  }
  template <class Value>
  Hash& operator<<(const std::vector<Value>& values) {
    *this << std::uint64_t{values.size()};
    for (const Value& value : values) *this << value;
    return *this;
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = host::fnv1a_start;
};

std::uint64_t content(const ref::Scene& scene, const ref::Bvh& bvh, std::span<const AskedRay> rays) {
  const ref::Mesh& mesh = scene.mesh;
  const ref::Camera& camera = scene.camera;
  Hash hash;
  hash << mesh.vertices << mesh.normals << mesh.triangles << mesh.materials << scene.materials << scene.lights
       << bvh.nodes << bvh.order;
  hash << camera.eye << camera.forward << camera.right << camera.up << camera.tan_half_height
       << camera.projection << camera.half_height;
  for (const AskedRay& asked : rays) hash << asked.ray << asked.query;
  return hash.value();
}

}  // namespace

SweepSubject sweep_subject(const ref::Scene& scene, const ref::Bvh& bvh, const SweepOptions& options) {
  const bool picture = options.rays.empty();
  const ref::WhittedOptions& light = options.light;
  const bool random = picture && (light.diffuse > 0 || light.occlusion > 0);
  return {.program = printable(options.program),
          .scene = printable(scene.name),
          .content = fmt::format("fnv1a-{:016x}", content(scene, bvh, options.rays)),
          .triangles = scene.mesh.triangles.size(),
          .hierarchy = printable(options.hierarchy),
          .bvh_nodes = bvh.nodes.size(),
          .width = picture ? options.width : 0,
          .height = picture ? options.height : 0,
          .bounces = picture ? light.bounces : 0,
          .diffuse = picture ? light.diffuse : 0,
          .occlusion = picture ? light.occlusion : 0,
          .light_seed = random ? light.seed : 0,
          .library = printable(options.library->name()),
          .cost = options.tests_only ? "tests" : "tests and set-up"};
}

std::string SweepSubject::text() const {
  std::string rays =
      width == 0 ? "rays of a file" : fmt::format("{} x {} pixels, {} bounces", width, height, bounces);
  if (diffuse > 0) rays += fmt::format(", {} diffuse", diffuse);
  if (occlusion > 0) rays += fmt::format(", {} occlusion", occlusion);
  if (light_seed > 0) rays += fmt::format(", light seed {}", light_seed);
  return fmt::format("{}: {}, content {}, hierarchy {}, {}, library {}, cost of {}", program, scene, content,
                     hierarchy, rays, library, cost);
}

}  // namespace hitpipe::sim
