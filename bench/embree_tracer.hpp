// Embree 3, one ray at a time: a well-known tracer to compare with. For benchmarks only.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include <embree3/rtcore.h>

#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::bench {

struct EmbreeOptions {
  const char* device = nullptr;  ///< as rtcNewDevice() reads it; null: Embree's own choice
  bool robust = false;           ///< RTC_SCENE_FLAG_ROBUST
  bool filters = false;          ///< count() may be asked
};

class EmbreeTracer {
 public:
  explicit EmbreeTracer(const ref::Mesh& mesh, const EmbreeOptions& options = {})
      : device_(rtcNewDevice(options.device)) {
    if (!device_) throw std::runtime_error("Embree: no device");
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* bytes, ssize_t more, bool) {
          *static_cast<std::size_t*>(bytes) += static_cast<std::size_t>(more);
          return true;
        },
        &bytes_);
    scene_ = rtcNewScene(device_);
    int flags = options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
    if (options.filters) flags |= RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(flags));
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        vertices[3 * i + static_cast<std::size_t>(axis)] = mesh.vertices[i][axis];
      }
    }
    auto* const indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (int corner = 0; corner < 3; ++corner) {
        indices[3 * i + static_cast<std::size_t>(corner)] = mesh.triangles[i][corner];
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;
  ~EmbreeTracer() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// Embree's number for "no triangle" equals Hit::none. Each query also has t, u, v and the normal.
  void trace(std::span<const ref::Ray> rays, std::span<std::uint32_t> triangles) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit query = query_of(rays[i]);
      rtcIntersect1(scene_, &context, &query);
      triangles[i] = query.hit.primID;
    }
  }
  /// 1 where there is any hit.
  void any(std::span<const ref::Ray> rays, std::span<std::uint32_t> met) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRay ray = query_of(rays[i]).ray;
      rtcOccluded1(scene_, &context, &ray);
      met[i] = ray.tfar < 0 ? 1 : 0;
    }
  }
  /// All hits, by a filter that counts and refuses each. The scene needs `filters`.
  void count(std::span<const ref::Ray> rays, std::span<std::uint32_t> counts) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Counting counting{};
      rtcInitIntersectContext(&counting.context);
      counting.context.filter = [](const RTCFilterFunctionNArguments* hit) {
        ++reinterpret_cast<Counting*>(hit->context)->found;
        hit->valid[0] = 0;
      };
      RTCRayHit query = query_of(rays[i]);
      rtcIntersect1(scene_, &counting.context, &query);
      counts[i] = counting.found;
    }
  }
  /// Bytes that it has asked for: its buffers and its tree.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Counting {
    RTCIntersectContext context;
    std::uint32_t found;
  };
  static RTCRayHit query_of(const ref::Ray& ray) {
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x;
    query.ray.org_y = ray.origin.y;
    query.ray.org_z = ray.origin.z;
    query.ray.dir_x = ray.direction.x;
    query.ray.dir_y = ray.direction.y;
    query.ray.dir_z = ray.direction.z;
    query.ray.tfar = ray.length;
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    return query;
  }

  std::size_t bytes_ = 0;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace hitpipe::bench
