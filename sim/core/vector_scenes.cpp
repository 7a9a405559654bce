#include "sim/core/vector_scenes.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "hls/machines/block_kind.hpp"
#include "rays/tree/refit.hpp"
#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

using ref::adversary::Random;

namespace {

/// -1..1
float coordinate(Random& random) {
  return static_cast<float>(random.between(-1'000'000, 1'000'000)) * 1e-6F;
}

}  // namespace

glm::vec3 random_point(Random& random) {
  const float x = coordinate(random), y = coordinate(random), z = coordinate(random);
  return {x, y, z};
}

namespace {

/// Of corners that are drawn for each triangle.
template <class Draw>
ref::Scene scene_of(std::uint32_t triangles, const Draw& corner) {
  ref::Scene scene;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    scene.mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    for (int each = 0; each < 3; ++each) scene.mesh.vertices.push_back(corner(each));
  }
  return scene;
}

}  // namespace

ref::Scene random_scene(std::uint32_t triangles, float size, Random& random) {
  glm::vec3 middle{};
  return scene_of(triangles, [&](int corner) {
    if (corner == 0) middle = random_point(random);
    return glm::clamp(middle + size * random_point(random), -1.0F, 1.0F);
  });
}

ref::Scene largest_scene(std::uint32_t triangles, Random& random) {
  ref::Scene scene = scene_of(triangles, [&](int) { return glm::sign(random_point(random)); });
  const glm::vec3 face[] = {{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}};
  for (std::size_t i = 0; i < std::min<std::size_t>(scene.mesh.vertices.size(), 6); ++i)
    scene.mesh.vertices[i] = face[i < 3 ? i : 5 - i];
  return scene;
}

ref::Scene joined(ref::Scene scene, const ref::Scene& other) {
  const auto before = static_cast<std::uint32_t>(scene.mesh.vertices.size());
  scene.mesh.vertices.insert(scene.mesh.vertices.end(), other.mesh.vertices.begin(),
                             other.mesh.vertices.end());
  for (const glm::uvec3& triangle : other.mesh.triangles) scene.mesh.triangles.push_back(triangle + before);
  return scene;
}

glm::vec3 point_of_one(const ref::IntScene& scene, Random& random) {
  const ref::Mesh& mesh = scene.mesh.mesh;
  const glm::uvec3& corners = mesh.triangles[random.below(mesh.triangles.size())];
  if (random.coin()) return mesh.vertices[corners.x];
  return (mesh.vertices[corners.x] + mesh.vertices[corners.y] + mesh.vertices[corners.z]) / 3.0F;
}

Lattice::Lattice(int coord_bits, Random& random)
    : random_(random), half_((1 << (coord_bits - 2)) - 1), step_(half_ / 4) {}

ref::Scene Lattice::scene(std::uint32_t triangles) {
  ref::Scene scene;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    scene.mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    // Some are there twice, or the other way round.
    const std::size_t before = i == 0 ? 0 : 3 * random_.below(i);
    const int copies = i == 0 ? 0 : random_.between(0, 3);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t from = before + (copies == 1 ? corner : 2 - corner);
      scene.mesh.vertices.push_back(copies == 1 || copies == 2 ? scene.mesh.vertices[from] : place());
    }
  }
  return scene;
}

ref::Ray Lattice::ray() {
  ref::Ray ray{.origin = place(), .direction = {}};
  while (ray.direction == glm::vec3(0))
    for (int axis = 0; axis < 3; ++axis) ray.direction[axis] = static_cast<float>(random_.between(-1, 1));
  // To a place, or without an end.
  ray.length = random_.below(3) == 0 ? ref::Ray::infinite : at(random_.between(0, 6));
  return ray;
}

float Lattice::at(int steps) const {
  return static_cast<float>(static_cast<double>(steps * step_) / half_);
}
glm::vec3 Lattice::place() {
  const int step = random_.coin() ? 1 : 3;
  const auto one = [&] { return at(step * random_.between(-3 / step, 3 / step)); };
  const float x = one(), y = one(), z = one();
  return {x, y, z};
}

Traced traced(const rtl::CoreOptions& options, std::uint32_t triangles,
              const std::function<ref::IntScene(std::uint32_t)>& make) {
  const std::uint64_t most_blocks = std::uint64_t{1} << options.address_bits;
  for (;; triangles /= 2) {
    ref::IntScene scene = make(triangles);
    ref::CoreImage image = ref::core_image(scene);
    const bool fits = image.header.levels <= options.levels && image.blocks.size() <= most_blocks &&
                      image.header.number_bits() <= options.number_bits &&
                      image.header.leaf_bits() <= options.leaf_bits;
    if (fits || triangles == 1) return {std::move(scene), std::move(image)};
  }
}

ref::IntScene chained(ref::IntScene scene, int branches, Random& random) {
  const ref::Mesh& mesh = scene.mesh.mesh;
  std::vector<std::uint32_t> numbers(mesh.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  const std::size_t leaves = std::min(static_cast<std::size_t>(branches) + 1, numbers.size());
  // Each leaf has a triangle, and then one of them gets the next.
  std::vector<std::int32_t> counts(leaves, 1);
  for (std::size_t i = leaves; i < numbers.size(); ++i) ++counts[random.below(leaves)];

  ref::Bvh bvh{.nodes = {{}}, .order = numbers};
  std::size_t branch = 0;
  std::uint32_t first = 0;
  const auto make_leaf = [&](std::size_t node, std::size_t leaf) {
    bvh.nodes[node].count = counts[leaf];
    bvh.nodes[node].first = first;
    first += static_cast<std::uint32_t>(counts[leaf]);
  };
  for (std::size_t leaf = 0; leaf + 1 < leaves; ++leaf) {
    const std::size_t children = bvh.nodes.size();
    bvh.nodes[branch].count = -1;
    bvh.nodes[branch].first = static_cast<std::uint32_t>(children);
    bvh.nodes.resize(children + 2);
    // Of equally near children the first is visited, and the other one put on the stack.
    const std::size_t which = random.below(8) == 0 ? 0 : 1;
    make_leaf(children + which, leaf);
    branch = children + 1 - which;
  }
  make_leaf(branch, leaves - 1);
  bvh.depth = static_cast<int>(leaves);
  scene.bvh = ref::refitted(bvh, mesh, numbers);
  return scene;
}

ref::CoreImage renumbered(ref::CoreImage image, const std::function<std::uint32_t(std::uint32_t)>& number) {
  const int grid = image.header.coord_bits;
  const auto triangle_kind = static_cast<std::uint64_t>(hls::kind_byte(hls::triangle_block, grid));
  for (ref::CoreBlock& block : image.blocks) {
    if (block.back() >> 56 != triangle_kind) continue;
    ref::CoreTriangle triangle = ref::triangle_of(block);
    triangle.number = number(triangle.number);
    block = to_block(triangle, grid);
  }
  return image;
}

ref::CoreImage damaged(ref::CoreImage image, const rtl::CoreOptions& options, Random& random) {
  const int grid = options.bits.coord;
  const auto record_kind = static_cast<std::uint64_t>(hls::kind_byte(hls::record_block, grid));
  // Rays come to the first record, and then to some of the others.
  constexpr std::size_t first = 1 + ref::header_blocks;
  if (image.blocks.size() > first && image.blocks[first].back() >> 56 == record_kind) {
    ref::CoreRecord record = ref::record_of(image.blocks[first]);
    record.counts[0] = ref::PairChild::none;
    image.blocks[first] = to_block(record, grid);
  }
  for (std::size_t place = first + 1; place < image.blocks.size(); ++place) {
    ref::CoreBlock& block = image.blocks[place];
    const bool is_record = block.back() >> 56 == record_kind;
    if (random.below(is_record ? 2 : 8) != 0) continue;
    ref::CoreRecord record = ref::record_of(block);
    switch (random.between(0, is_record ? 6 : 1)) {
      case 0:
        block = {};
        break;
      case 1:
        block.back() ^= std::uint64_t{1} << random.between(56, 63);
        break;
      case 2:
      case 3:
        record.pointer ^= 1U << random.between(0, options.address_bits - 1);
        if (random.coin())
          record.pointer = static_cast<std::uint32_t>(
              random.bits() >> (64 - random.between(1, random.coin() ? 32 : options.address_bits)));
        block = to_block(record, grid);
        break;
      case 4:
        // The second child is behind the last number of a block, or of half as many.
        record.pointer =
            static_cast<std::uint32_t>(rtl::ones_below(options.address_bits - random.between(0, 1)));
        block = to_block(record, grid);
        break;
      default:
        record.counts[random.below(2)] = random.below(4) == 0 ? random.between(1, 254) : ref::PairChild::none;
        block = to_block(record, grid);
    }
  }
  return image;
}

}  // namespace hitpipe::sim
