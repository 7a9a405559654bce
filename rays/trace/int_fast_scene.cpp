#include "rays/trace/int_fast_scene.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>

#include "host/parallel.hpp"
#include "rays/exact/binary32.hpp"
#include "rays/exact/quick_numbers.hpp"
#include "rays/tree/small_leaves.hpp"
#include "rays/world/int_boxes.hpp"
#include "rays/world/object_space.hpp"

namespace hitpipe::ref {

namespace {

constexpr int float_digits = std::numeric_limits<float>::digits;

/// Origins are below 2^(n-2+g), directions at most 2^S.
bool origins_fit(const hls::WorldBits& bits) {
  return bits.coord - 2 + bits.finer <= float_digits;
}
bool directions_fit(const hls::WorldBits& bits) {
  return bits.slope <= float_digits;
}

/// The least binary32 that is not below x, and the greatest that is not above it.
float above(double x) {
  return x >= 0                         ? rounded_up(x)
         : -static_cast<float>(-x) >= x ? -static_cast<float>(-x)
                                        : std::nextafter(static_cast<float>(x), 0.0F);
}
float below(double x) {
  return -above(-x);
}

Aabb float_box(const IntBox& box, float padding) {
  const auto& [low_x, low_y, low_z] = box.min;
  const auto& [high_x, high_y, high_z] = box.max;
  return {glm::vec3(low_x, low_y, low_z) - padding, glm::vec3(high_x, high_y, high_z) + padding};
}

CornerMap corner_map(const GridMap& map) {
  CornerMap made;
  const double unit = power_of_two(-map.fraction);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) made.matrix[k][j] = map.matrix[k][j] * unit;
    made.move[k] = map.move[k] + (map.fraction > 0 ? 0.5 : 0.0);
  }
  made.mirrors = map.mirrors();
  return made;
}

/// A ray in an object, in units of its corners: 1 along its major axis.
class ObjectFloats {
 public:
  ObjectFloats(const ObjectRay& ray, const ObjectSpace& space, const hls::WorldBits& bits)
      : ray_(ray), object_() {
    const double unit = std::ldexp(1.0, -bits.finer);
    const auto size = static_cast<double>(std::abs(ray.direction()[static_cast<std::size_t>(ray.major())]));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      object_.ahead[axis] = above(static_cast<double>(ray.origin()[k] + space.slack[k]) * unit);
      object_.behind[axis] = below(static_cast<double>(ray.origin()[k] - space.slack[k]) * unit);
      object_.direction[axis] = static_cast<float>(static_cast<double>(ray.direction()[k]) / size);
    }
  }
  /// Where a hit at T is at most.
  [[nodiscard]] float length(std::int64_t t) const {
    const std::int64_t steps = ray_.distance(t, fraction, largest);
    return steps < 0 ? -1.0F : rounded_up(static_cast<double>(steps + 1) * std::ldexp(1.0, -fraction));
  }
  const SlackRay& cut(std::int64_t t) {
    object_.length = length(t);
    return object_;
  }

 private:
  static constexpr int fraction = 4;
  static constexpr std::int64_t largest = std::int64_t{1} << 50;

  const ObjectRay& ray_;
  SlackRay object_;
};

}  // namespace

AfterLeaf IntSink::meets(const TrianglePack& pack, unsigned may_hit) {
  AfterLeaf after = AfterLeaf::same;
  for (; may_hit != 0; may_hit &= may_hit - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(may_hit));
    IntTriangle triangle;
    for (std::size_t i = 0; i < 9; ++i)
      triangle.corners[i / 3][i % 3] = static_cast<std::int32_t>(pack.corners[i][lane]);
    const IntInterest interest = visitor_.meets(base_ + pack.triangles[lane], triangle);
    stopped_ = interest.stop;
    if (stopped_) return AfterLeaf::stop;
    if (!interest.up_to) continue;
    up_to_ = *interest.up_to;
    after = AfterLeaf::shorter;
  }
  return after;
}

/// An origin that does not fit is below 2^22 in units of corners, with n = 24, so it is rounded by 1/8 at most, and
/// boxes that are larger by 1/2 hold all. Their planes are halves below 2^22, which binary32 has.
FloatRays::FloatRays(const hls::WorldBits& bits)
    : origin_unit_(std::ldexp(1.0F, -bits.finer)),
      direction_unit_(std::ldexp(1.0F, -bits.slope)),
      length_unit_(std::ldexp(1.0, -bits.finer - bits.fraction)),
      padding_(origins_fit(bits) ? 0.0F : 0.5F),
      allowance_(origins_fit(bits) && directions_fit(bits) ? 1.0F : 1.5F) {}

float FloatRays::length(std::int64_t t) const {
  return rounded_up(static_cast<double>(t + 1) * length_unit_);
}

Ray FloatRays::operator()(const IntRay& ray) const {
  Ray made;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    made.origin[axis] = static_cast<float>(ray.origin[i]) * origin_unit_;
    made.direction[axis] = static_cast<float>(ray.direction[i]) * direction_unit_;
  }
  made.length = length(ray.length);
  return made;
}

Bvh with_boxes(const Bvh& bvh, std::span<const IntBox> boxes, float padding) {
  Bvh made = bvh;
  for (std::size_t i = 0; i < boxes.size(); ++i) made.nodes[i].box = float_box(boxes[i], padding);
  return made;
}

Mesh::Corners float_corners(const IntTriangle& triangle) {
  const auto corner = [&](std::size_t i) {
    const auto& [x, y, z] = triangle.corners[i];
    return glm::vec3(x, y, z);
  };
  return {corner(0), corner(1), corner(2)};
}

IntFastScene::IntFastScene(const IntMesh& mesh, const Bvh& bvh, const hls::WorldBits& bits, VectorWidth width)
    : rays_(bits),
      scene_(fast_scene(
          with_boxes(bvh, int_boxes(mesh.triangles, bvh), rays_.padding()),
          [&](std::uint32_t triangle) { return float_corners(mesh.triangles[triangle]); }, width)) {}

void IntFastScene::walk(const IntRay& ray, IntVisitor& visitor) const {
  class Sink final : public IntSink {
   public:
    Sink(IntVisitor& its_visitor, const FloatRays& rays) : IntSink(its_visitor, 0), rays_(rays) {}
    [[nodiscard]] float length() const override { return rays_.length(up_to()); }

   private:
    const FloatRays& rays_;
  };
  const Ray made = rays_(ray);
  Sink sink(visitor, rays_);
  FastWork work;
  scene_->walk(made, scene_->largest_reach(made) * rays_.allowance(), sink, work);
}

FastInstances::FastInstances(const IntInstances& world, VectorWidth width)
    : world_(world), rays_(world.bits()) {
  for (const IntInstances::Entry& entry : world.entries()) {
    const std::uint32_t number = world.instances()[entry.instance].mesh;
    const IntObject& mesh = world.meshes()[number];
    auto& part = parts_[{number, entry.node}];
    if (!part)
      part = fast_scene(
          below(with_boxes(mesh.bvh(), mesh.boxes(), 0.0F), entry.node),
          [&](std::uint32_t triangle) { return float_corners(mesh.triangles()[triangle]); }, width);
    scenes_.push_back(part.get());
  }
  for (const IntInstance& instance : world.instances()) maps_.push_back(corner_map(instance.map));
  if (!world.top().nodes.empty())
    top_ = fast_boxes(with_boxes(world.top(), world.top_boxes(), rays_.padding()), width);
}

void FastInstances::follow(std::uint32_t first, std::size_t count, std::span<const std::uint32_t> moved) {
  host::for_each_block(first, first + count, 4096, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) maps_[i] = corner_map(world_.instances()[i].map);
  });
  // Leaves near each other in one hierarchy are so in the other, and their entries need not be.
  if (top_)
    top_->refit(moved,
                [&](std::uint32_t entry) { return float_box(world_.leaf_box(entry), rays_.padding()); });
}

void FastInstances::walk(const IntRay& ray, std::uint8_t mask, IntVisitor& visitor) const {
  /// In an object it is asked for distances there.
  class Sink final : public IntSink {
   public:
    Sink(IntVisitor& its_visitor, std::uint32_t its_base, const ObjectFloats& in_object, std::int64_t& up_to)
        : IntSink(its_visitor, its_base), in_object_(in_object), up_to_(up_to) {}
    [[nodiscard]] float length() const override {
      up_to_ = up_to();
      return in_object_.length(up_to_);
    }

   private:
    const ObjectFloats& in_object_;
    std::int64_t& up_to_;
  };
  class Top final : public FastBoxSink {
   public:
    Top(const FastInstances& scene, const IntRay& ray, std::uint8_t mask, IntVisitor& visitor)
        : scene_(scene),
          ray_(ray),
          made_(scene.rays_(ray)),
          mask_(mask),
          visitor_(visitor),
          up_to_(ray.length) {
      const float far =
          std::max({std::fabs(made_.origin.x), std::fabs(made_.origin.y), std::fabs(made_.origin.z)});
      reach_ = (static_cast<float>(scene.world_.bits().largest_corner()) + far) * scene.rays_.allowance();
    }
    [[nodiscard]] const Ray& ray() const { return made_; }
    AfterLeaf enters(std::uint32_t number) override {
      const IntInstances::Entry& entry = scene_.world_.entries()[number];
      const IntInstance& instance = scene_.world_.instances()[entry.instance];
      if ((instance.mask & mask_) == 0) return AfterLeaf::same;
      const auto inside = ObjectRay::enter(entry.space, instance.map, ray_, up_to_, scene_.world_.bits());
      if (!inside) return AfterLeaf::same;
      ObjectFloats in_object(*inside, entry.space, scene_.world_.bits());
      const std::int64_t before = up_to_;
      Sink sink(visitor_, scene_.world_.base(entry.instance), in_object, up_to_);
      const PlacedRay placed{made_, reach_, in_object.cut(up_to_), scene_.maps_[entry.instance]};
      scene_.scenes_[number]->walk(placed, sink);
      if (sink.stopped()) return AfterLeaf::stop;
      return up_to_ == before ? AfterLeaf::same : AfterLeaf::shorter;
    }
    [[nodiscard]] float length() const override { return scene_.rays_.length(up_to_); }

   private:
    const FastInstances& scene_;
    const IntRay& ray_;
    Ray made_;
    std::uint8_t mask_;
    IntVisitor& visitor_;
    std::int64_t up_to_;
    float reach_ = 0;
  };
  if (!top_) return;
  Top top(*this, ray, mask, visitor);
  top_->walk(top.ray(), top);
}

}  // namespace hitpipe::ref
