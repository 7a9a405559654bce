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

std::uint64_t content(const ref::Scene& scene, const ref::Bvh& bvh) {
  const ref::Mesh& mesh = scene.mesh;
  const ref::Camera& camera = scene.camera;
  Hash hash;
  hash << mesh.vertices << mesh.normals << mesh.triangles << mesh.materials << scene.materials << scene.lights
       << bvh.nodes << bvh.order;
  hash << camera.eye << camera.forward << camera.right << camera.up << camera.tan_half_height
       << camera.projection << camera.half_height;
  return hash.value();
}

}  // namespace

SweepSubject sweep_subject(const ref::Scene& scene, const ref::Bvh& bvh, const SweepOptions& options) {
  return {.program = printable(options.program),
          .scene = printable(scene.name),
          .content = fmt::format("fnv1a-{:016x}", content(scene, bvh)),
          .triangles = scene.mesh.triangles.size(),
          .hierarchy = printable(options.hierarchy),
          .bvh_nodes = bvh.nodes.size(),
          .width = options.width,
          .height = options.height,
          .bounces = options.light.bounces,
          .library = printable(options.library->name()),
          .cost = options.tests_only ? "tests" : "tests, set-up"};
}

std::string SweepSubject::text() const {
  return fmt::format("{}: {}, content {}, hierarchy {}, {} x {} pixels, {} bounces, library {}, cost of {}",
                     program, scene, content, hierarchy, width, height, bounces, library, cost);
}

}  // namespace hitpipe::sim
