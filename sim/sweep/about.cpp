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

std::string about_sweep(const std::string& program, const ref::Scene& scene, const ref::Bvh& bvh,
                        const SweepOptions& options) {
  return fmt::format("{} sweep: {}, content {:016x}, {} x {} pixels, {} bounces, library {}", program,
                     printable(scene.name), content(scene, bvh), options.width, options.height,
                     options.light.bounces, printable(options.library->name()));
}

}  // namespace hitpipe::sim
