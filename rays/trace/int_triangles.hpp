// The triangles of an integer world as whoever asks about a ray sees them: those that the ray may hit, one by one.
// Behind it is a mesh or instances, and a walk with exact boxes or with those of a format. Answers are the same.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "rays/trace/int_tracer.hpp"
#include "rays/trace/vector_width.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/instances.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::ref {

/// What a walk does after a triangle.
struct IntInterest {
  /// T up to which the walk is of interest from then on, that T included; nothing: no change.
  std::optional<std::int64_t> up_to{};
  bool stop = false;
};

class IntVisitor {
 public:
  virtual IntInterest meets(std::uint32_t number, const IntTriangle& triangle) = 0;

 protected:
  ~IntVisitor() = default;
};

/// Thread-safe.
class IntTriangles {
 public:
  virtual ~IntTriangles() = default;

  /// Tells the visitor of every triangle that the ray hits within its length and what is of interest, once, and of
  /// others. The ray does not see instances whose mask has no bit of `mask`.
  virtual void walk(const IntRay& ray, std::uint8_t mask, IntVisitor& visitor) const = 0;
  /// The triangle with this number, which is one of those that a walk gave.
  [[nodiscard]] virtual IntTriangle triangle(std::uint32_t number) const = 0;

  /// The same with meets(number, triangle), which gives the interest.
  template <class Meets>
  void each(const IntRay& ray, std::uint8_t mask, const Meets& meets) const {
    class Visitor final : public IntVisitor {
     public:
      explicit Visitor(const Meets& its_meets) : meets_(its_meets) {}
      IntInterest meets(std::uint32_t number, const IntTriangle& triangle) override {
        return meets_(number, triangle);
      }

     private:
      const Meets& meets_;
    };
    Visitor visitor(meets);
    walk(ray, mask, visitor);
  }
};

/// `bvh` is a hierarchy over mesh.mesh; nothing, for a mesh without triangles. The mesh must outlive it, and with a
/// format of boxes the hierarchy too. Throws as check_world() and fast_tracer().
[[nodiscard]] std::unique_ptr<IntTriangles> int_triangles(const IntMesh& mesh, const Bvh* bvh,
                                                          const IntTracerOptions& options, VectorWidth width);
/// The instances must outlive it. Boxes of a format are tested as a core tests them (docs/instances.md).
[[nodiscard]] std::unique_ptr<IntTriangles> int_triangles(const IntInstances& world,
                                                          const IntTracerOptions& options, VectorWidth width);

}  // namespace hitpipe::ref
