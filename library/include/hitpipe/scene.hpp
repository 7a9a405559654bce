// <hitpipe/scene.h> for C++20: a scene that closes itself, vectors in place of pointers, exceptions of one line. What
// numbers mean, and the rules for threads, are there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <hitpipe/ref.hpp>
#include <hitpipe/scene.h>

namespace hitpipe {

using SceneInfo = hitpipe_scene_info;
using Node = hitpipe_node;
using IntegerRay = hitpipe_integer_ray;

inline constexpr std::uint32_t no_triangle = HITPIPE_NO_TRIANGLE;

using Point = std::array<float, 3>;
using TriangleCorners = std::array<std::uint32_t, 3>;

/// As hitpipe_scene_options.
struct SceneOptions {
  std::string world = "float";
  const Transform* transform = nullptr;  ///< of an integer world; nothing: chosen
  std::span<const Node> nodes{};         ///< a hierarchy of your own, with its order; empty: built
  std::span<const std::uint32_t> order{};
  int threads = 0;
  /// Of an integer world whose transform is chosen: places that are to be in its cube, too, such as a camera's.
  std::span<const Point> contains{};
};

/// One of each for each ray.
struct Nearest {
  std::vector<std::uint32_t> triangle;
  std::vector<double> t;
  std::vector<std::array<double, 3>> weights;  ///< empty if they were not asked for
};
struct Counts {
  std::vector<std::uint32_t> crossings;
  std::vector<std::int32_t> sides;
};
/// Those of ray i are at offsets[i] to offsets[i + 1] - 1.
struct Crossings {
  std::vector<std::uint64_t> offsets;
  std::vector<std::uint32_t> triangle;
  std::vector<double> t;
  std::vector<std::int8_t> side;
};

using Instance = hitpipe_instance;
using Part = hitpipe_part;
/// Three rows of four, as hitpipe_instance has it.
using Matrix = std::array<double, 12>;

/// A mesh that instances show.
struct InstanceMesh {
  std::span<const Point> corners;
  std::span<const TriangleCorners> triangles;
};

/// Any number of threads may ask one scene while another moves it. `threads` is how many a call takes, 0: one a core.
class Scene {
 public:
  Scene(std::span<const Point> corners, std::span<const TriangleCorners> triangles,
        const SceneOptions& options = {})
      : corner_count_(corners.size()) {
    const hitpipe_mesh mesh{corners.empty() ? nullptr : corners.front().data(), corners.size(),
                            triangles.empty() ? nullptr : triangles.front().data(), triangles.size()};
    if (options.nodes.empty() && !options.order.empty())
      throw std::invalid_argument("order of the hierarchy: it has no nodes; a hierarchy has both");
    if (!options.nodes.empty() && options.order.size() != triangles.size())
      throw std::invalid_argument("order of the hierarchy: " + std::to_string(options.order.size()) +
                                  " triangles; the mesh has " + std::to_string(triangles.size()));
    const hitpipe_hierarchy hierarchy{options.nodes.data(), options.nodes.size(), options.order.data()};
    hitpipe_scene_options chosen{options.world.c_str(), options.nodes.empty() ? nullptr : &hierarchy,
                                 options.transform, options.threads};
    Transform fitted;
    if (!options.contains.empty()) {
      if (options.world == "float")
        throw std::invalid_argument("contains: the float world has no cube; it takes rays from everywhere");
      if (options.transform != nullptr)
        throw std::invalid_argument("contains: a transform is given; it alone says what the cube holds");
      check(hitpipe_fit_scene(&mesh, options.contains.front().data(), options.contains.size(), &fitted));
      chosen.transform = &fitted;
    }
    hitpipe_scene* made = nullptr;
    check(hitpipe_scene_open(&mesh, &chosen, &made));
    scene_.reset(made);
  }

  /// Meshes and instances, in an integer world; without a hierarchy of your own.
  [[nodiscard]] static Scene of_instances(std::span<const InstanceMesh> meshes,
                                          std::span<const Instance> instances, const SceneOptions& options) {
    std::vector<hitpipe_mesh> own;
    for (const InstanceMesh& mesh : meshes)
      own.push_back({mesh.corners.empty() ? nullptr : mesh.corners.front().data(), mesh.corners.size(),
                     mesh.triangles.empty() ? nullptr : mesh.triangles.front().data(),
                     mesh.triangles.size()});
    if (!options.nodes.empty() || !options.order.empty())
      throw std::invalid_argument("nodes and order: a scene of instances builds its own hierarchy");
    hitpipe_scene_options chosen{options.world.c_str(), nullptr, options.transform, options.threads};
    Transform fitted;
    if (!options.contains.empty()) {
      if (options.transform != nullptr)
        throw std::invalid_argument("contains: a transform is given; it alone says what the cube holds");
      check(hitpipe_fit_instances(own.data(), own.size(), instances.data(), instances.size(),
                                  options.contains.front().data(), options.contains.size(), &fitted));
      chosen.transform = &fitted;
    }
    hitpipe_scene* made = nullptr;
    check(hitpipe_scene_open_instances(own.data(), own.size(), instances.data(), instances.size(), &chosen,
                                       &made));
    return {made, 0};
  }

  /// For calls of the C interface; closed with this object.
  [[nodiscard]] hitpipe_scene* handle() const { return scene_.get(); }
  [[nodiscard]] SceneInfo info() const {
    SceneInfo info;
    check(hitpipe_scene_describe(scene_.get(), &info));
    return info;
  }

  /// As many corners as the scene has.
  void move(std::span<const Point> corners, int threads = 0) {
    if (corners.size() != corner_count_)
      throw std::invalid_argument("move: " + std::to_string(corners.size()) + " corners; the scene has " +
                                  std::to_string(corner_count_));
    if (corners.empty()) return;
    check(hitpipe_scene_move(scene_.get(), corners.front().data(), threads));
  }

  /// New matrices for the instances from `first` on.
  void place(std::size_t first, std::span<const Matrix> matrices, int threads = 0) {
    if (matrices.empty()) return;
    check(hitpipe_scene_place(scene_.get(), first, matrices.front().data(), matrices.size(), threads));
  }
  /// The same scene for rays that have this mask: what one moves, both have moved.
  [[nodiscard]] Scene masked(std::uint8_t mask) const {
    hitpipe_scene* made = nullptr;
    check(hitpipe_scene_masked(scene_.get(), mask, &made));
    return {made, corner_count_};
  }
  /// What triangles of answers are.
  [[nodiscard]] std::vector<Part> parts(std::span<const std::uint32_t> triangles) const {
    std::vector<Part> all(triangles.size());
    check(hitpipe_parts(scene_.get(), triangles.data(), triangles.size(), all.data()));
    return all;
  }

  [[nodiscard]] Nearest nearest(std::span<const Ray> rays, bool weights = true, int threads = 0) const {
    Nearest all{std::vector<std::uint32_t>(rays.size()), std::vector<double>(rays.size()),
                std::vector<std::array<double, 3>>(weights ? rays.size() : 0)};
    const hitpipe_nearest_out out{all.triangle.data(), all.t.data(),
                                  all.weights.empty() ? nullptr : all.weights.front().data()};
    check(hitpipe_nearest(scene_.get(), rays.data(), rays.size(), threads, &out));
    return all;
  }
  /// 1 for each ray that hits a triangle.
  [[nodiscard]] std::vector<std::uint8_t> any(std::span<const Ray> rays, int threads = 0) const {
    std::vector<std::uint8_t> met(rays.size());
    check(hitpipe_any(scene_.get(), rays.data(), rays.size(), threads, met.data()));
    return met;
  }
  [[nodiscard]] Counts count(std::span<const Ray> rays, int threads = 0) const {
    Counts all{std::vector<std::uint32_t>(rays.size()), std::vector<std::int32_t>(rays.size())};
    check(hitpipe_count(scene_.get(), rays.data(), rays.size(), threads, all.crossings.data(),
                        all.sides.data()));
    return all;
  }
  [[nodiscard]] Crossings all(std::span<const Ray> rays, int threads = 0) const {
    Crossings found;
    found.offsets.resize(rays.size() + 1);
    // A guess that often holds them all; if not, the second call has enough.
    for (std::size_t capacity = 4 * rays.size();; capacity = found.offsets.back()) {
      found.triangle.resize(capacity);
      found.t.resize(capacity);
      found.side.resize(capacity);
      const hitpipe_all_out out{found.offsets.data(), capacity, found.triangle.data(), found.t.data(),
                                found.side.data()};
      check(hitpipe_all(scene_.get(), rays.data(), rays.size(), threads, &out));
      if (found.offsets.back() <= capacity) break;
    }
    found.triangle.resize(found.offsets.back());
    found.t.resize(found.offsets.back());
    found.side.resize(found.offsets.back());
    return found;
  }
  /// 1 for each point from which a ray crosses the mesh, which must be closed, an odd number of times. Of solids that
  /// overlap, count().sides of rays without an end are winding numbers.
  [[nodiscard]] std::vector<std::uint8_t> inside(std::span<const Point> points, int threads = 0) const {
    std::vector<std::uint8_t> in(points.size());
    if (points.empty()) return in;
    check(hitpipe_inside(scene_.get(), points.front().data(), points.size(), threads, in.data()));
    return in;
  }

  // For a host of the traversal core.
  [[nodiscard]] std::vector<IntegerRay> integer_rays(std::span<const Ray> rays) const {
    std::vector<IntegerRay> all(rays.size());
    check(hitpipe_integer_rays(scene_.get(), rays.data(), rays.size(), all.data()));
    return all;
  }
  [[nodiscard]] double own_distance(const Ray& ray, std::int64_t core_t) const {
    double t = 0;
    check(hitpipe_own_distance(scene_.get(), &ray, core_t, &t));
    return t;
  }
  [[nodiscard]] std::vector<std::uint8_t> core_image() const {
    std::size_t size = 0;
    std::vector<std::uint8_t> bytes;
    // Another thread may move the scene, and the image may grow.
    do {
      bytes.resize(size);
      check(hitpipe_core_image(scene_.get(), bytes.data(), bytes.size(), &size));
    } while (size > bytes.size());
    bytes.resize(size);
    return bytes;
  }

 private:
  struct Close {
    void operator()(hitpipe_scene* scene) const { hitpipe_scene_close(scene); }
  };

  Scene(hitpipe_scene* made, std::size_t corner_count) : corner_count_(corner_count), scene_(made) {}

  std::size_t corner_count_;
  std::unique_ptr<hitpipe_scene, Close> scene_;
};

}  // namespace hitpipe
