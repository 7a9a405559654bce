#include "rays/trace/int_triangles.hpp"

#include <vector>

#include "rays/trace/instance_walk.hpp"
#include "rays/trace/int_box_tests.hpp"
#include "rays/trace/int_fast_scene.hpp"
#include "rays/world/int_boxes.hpp"

namespace hitpipe::ref {

namespace {

class MeshTriangles : public IntTriangles {
 public:
  explicit MeshTriangles(const IntMesh& mesh) : mesh_(mesh) {}
  void walk(const IntRay& /*ray*/, std::uint8_t /*mask*/, IntVisitor& /*visitor*/) const override {}
  [[nodiscard]] IntTriangle triangle(std::uint32_t number) const override { return mesh_.triangles[number]; }

 private:
  const IntMesh& mesh_;
};

class FastMeshTriangles final : public MeshTriangles {
 public:
  FastMeshTriangles(const IntMesh& mesh, const Bvh& bvh, const hls::WorldBits& bits, VectorWidth width)
      : MeshTriangles(mesh), scene_(mesh, bvh, bits, width) {}
  void walk(const IntRay& ray, std::uint8_t /*mask*/, IntVisitor& visitor) const override {
    scene_.walk(ray, visitor);
  }

 private:
  IntFastScene scene_;
};

/// The visitor of a walk by boxes of a format. Such a walk goes to its end: from a stop on nothing is of interest.
class Asking {
 public:
  explicit Asking(IntVisitor& visitor) : visitor_(visitor) {}
  std::optional<std::int64_t> operator()(std::uint32_t number, const IntTriangle& triangle) {
    if (stopped_) return std::nullopt;
    const IntInterest interest = visitor_.meets(number, triangle);
    stopped_ = interest.stop;
    return stopped_ ? std::optional<std::int64_t>(0) : interest.up_to;
  }

 private:
  IntVisitor& visitor_;
  bool stopped_ = false;
};

class BoxedMeshTriangles final : public MeshTriangles {
 public:
  BoxedMeshTriangles(const IntMesh& mesh, const Bvh& bvh, const IntTracerOptions& options)
      : MeshTriangles(mesh), bvh_(bvh), options_(options), boxes_(int_boxes(mesh.triangles, bvh)) {}
  void walk(const IntRay& ray, std::uint8_t /*mask*/, IntVisitor& visitor) const override {
    IntBoxWalk walk(bvh_, IntWorld(bvh_, ray), Query::closest);
    Asking ask(visitor);
    walk_boxes(walk, MajorBoxes(ray, options_), boxes_,
               [&](std::uint32_t number) { return ask(number, triangle(number)); });
  }

 private:
  const Bvh& bvh_;
  IntTracerOptions options_;
  std::vector<IntBox> boxes_;
};

class BoxedInstances final : public IntTriangles {
 public:
  BoxedInstances(const IntInstances& world, const IntTracerOptions& options)
      : world_(world), options_(options) {}
  void walk(const IntRay& ray, std::uint8_t mask, IntVisitor& visitor) const override {
    InstanceWork work;
    Asking ask(visitor);
    walk_instances(world_, ray, mask, options_, ask, work);
  }
  [[nodiscard]] IntTriangle triangle(std::uint32_t number) const override { return world_.triangle(number); }

 private:
  const IntInstances& world_;
  IntTracerOptions options_;
};

}  // namespace

std::unique_ptr<IntTriangles> int_triangles(const IntMesh& mesh, const Bvh* bvh,
                                            const IntTracerOptions& options, VectorWidth width) {
  check_world(mesh, options);
  if (bvh == nullptr) return std::make_unique<MeshTriangles>(mesh);
  if (options.boxes) return std::make_unique<BoxedMeshTriangles>(mesh, *bvh, options);
  return std::make_unique<FastMeshTriangles>(mesh, *bvh, options.world, width);
}

std::unique_ptr<IntTriangles> int_triangles(const IntInstances& world, const IntTracerOptions& options,
                                            VectorWidth width) {
  if (!options.boxes) return std::make_unique<FastInstances>(world, width);
  check_box_format(options.world, *options.boxes);
  return std::make_unique<BoxedInstances>(world, options);
}

}  // namespace hitpipe::ref
