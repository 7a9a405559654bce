#include "rays/image/core_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/machines/block_kind.hpp"
#include "rays/exact/grid.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/world/int_boxes.hpp"
#include "rays/world/int_triangle.hpp"

namespace hitpipe::ref {

namespace {

constexpr int plane_bits = 24;
constexpr unsigned owners_at = 6 * plane_bits;
constexpr unsigned owner_bits = 6;
constexpr unsigned pointer_at = 160;
constexpr unsigned counts_at = 192;
constexpr unsigned count_bits = 8;
constexpr unsigned number_at = 9 * plane_bits;
constexpr unsigned kind_at = 248;
constexpr unsigned kind_bits = 8;
constexpr std::uint64_t count_of_branch = 255;

/// width <= 32
void put(CoreBlock& block, unsigned at, unsigned width, std::uint64_t value) {
  const std::uint64_t bits = value & ((std::uint64_t{1} << width) - 1);
  block[at / 64] |= bits << at % 64;
  if (at % 64 + width > 64) block[at / 64 + 1] |= bits >> (64 - at % 64);
}
std::uint64_t get(const CoreBlock& block, unsigned at, unsigned width) {
  std::uint64_t bits = block[at / 64] >> at % 64;
  if (at % 64 + width > 64) bits |= block[at / 64 + 1] << (64 - at % 64);
  return bits & ((std::uint64_t{1} << width) - 1);
}
void put_kind(CoreBlock& block, hls::BlockKind kind, int coord_bits) {
  put(block, kind_at, kind_bits, static_cast<std::uint64_t>(hls::kind_byte(kind, coord_bits)));
}
int kind_of(const CoreBlock& block) {
  return static_cast<int>(get(block, kind_at, kind_bits));
}
void put_coordinate(CoreBlock& block, unsigned place, std::int32_t x) {
  put(block, place * plane_bits, plane_bits, static_cast<std::uint32_t>(x));
}
std::int32_t coordinate(const CoreBlock& block, unsigned place) {
  constexpr int above = 32 - plane_bits;
  const auto bits = static_cast<std::uint32_t>(get(block, place * plane_bits, plane_bits));
  return static_cast<std::int32_t>(bits << above) >> above;
}

IntBox box_of(const IntTriangle& triangle) {
  IntBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = box.max[axis] = triangle.corners[0][axis];
    for (const IntTriangle::Corner& corner : triangle.corners) {
      box.min[axis] = std::min(box.min[axis], corner[axis]);
      box.max[axis] = std::max(box.max[axis], corner[axis]);
    }
  }
  return box;
}

bool holds(const IntBox& outer, const IntBox& inner) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (inner.min[axis] < outer.min[axis] || inner.max[axis] > outer.max[axis]) return false;
  return true;
}

/// The two boxes of a record, of which one is the parent's common box on each face.
std::array<IntBox, 2> boxes_in(const PairBoxes& pair, const IntBox& common) {
  std::array<IntBox, 2> boxes{common, common};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes[pair.owners >> axis & 1U].min[axis] = pair.planes.min[axis];
    boxes[pair.owners >> (axis + 3) & 1U].max[axis] = pair.planes.max[axis];
  }
  return boxes;
}

/// Writes a hierarchy from the root down.
class ImageWriter {
 public:
  explicit ImageWriter(const IntScene& scene) : scene_(scene), bvh_(*scene.bvh) {
    boxes_ = int_boxes(scene.mesh.triangles, bvh_);
  }

  CoreImage written() {
    image_.blocks.resize(1 + header_blocks);
    const Part root = part_of(0);
    write(0, {&root, 1}, 0);
    return std::move(image_);
  }

 private:
  /// A child: a branch of the hierarchy, or triangles, some of a leaf's if they are too many.
  struct Part {
    bool branch = false;
    std::uint32_t first = 0;  ///< node of child 0, or place in Bvh::order
    std::uint32_t count = 0;  ///< triangles
    IntBox box{};

    [[nodiscard]] bool is_record() const { return branch || count > CoreRecord::most_in_leaf; }
    [[nodiscard]] std::uint32_t blocks() const { return is_record() ? 1 : count; }
  };

  Part part_of(std::uint32_t node) const {
    const BvhNode& n = bvh_.nodes[node];
    return {!n.is_leaf(), n.first, n.is_leaf() ? static_cast<std::uint32_t>(n.count) : 0, boxes_[node]};
  }
  Part some_of(std::uint32_t first, std::uint32_t count) const {
    Part part{false, first, count, box_of(triangle(first))};
    for (std::uint32_t i = 1; i < count; ++i) part.box = union_of(part.box, box_of(triangle(first + i)));
    return part;
  }
  const IntTriangle& triangle(std::uint32_t place) const { return scene_.mesh.triangles[bvh_.order[place]]; }

  void write(std::uint32_t block, std::span<const Part> parts, int level) {
    if (level >= CoreImage::most_levels)
      throw std::runtime_error(
          fmt::format("the hierarchy has more than {} levels of records, which the core cannot walk; allowed "
                      "is a flatter one",
                      CoreImage::most_levels));
    image_.header.levels = std::max(image_.header.levels, level + 1);
    ++image_.records;
    CoreRecord record;
    record.pointer = static_cast<std::uint32_t>(image_.blocks.size());
    record.boxes = parts.size() == 2 ? pair_boxes(parts[0].box, parts[1].box) : PairBoxes{parts[0].box, 0};
    std::uint64_t needed = image_.blocks.size();
    for (const Part& part : parts) needed += part.blocks();
    if (needed > std::numeric_limits<std::uint32_t>::max())
      throw std::runtime_error("the image has more blocks than a pointer of 32 bits can name");
    image_.blocks.resize(needed);
    std::uint32_t at = record.pointer;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Part& part = parts[i];
      record.counts[i] = part.is_record() ? PairChild::branch : static_cast<std::int32_t>(part.count);
      if (!part.is_record()) write_triangles(at, part);
      at += part.blocks();
    }
    image_.blocks[block] = to_block(record, scene_.bits.coord);
    at = record.pointer;
    for (const Part& part : parts) {
      if (part.is_record()) write(at, children(part), level + 1);
      at += part.blocks();
    }
  }

  std::array<Part, 2> children(const Part& part) const {
    if (part.branch) return {part_of(part.first), part_of(part.first + 1)};
    const std::uint32_t half = part.count / 2;
    return {some_of(part.first, half), some_of(part.first + half, part.count - half)};
  }

  void write_triangles(std::uint32_t at, const Part& part) {
    for (std::uint32_t i = 0; i < part.count; ++i)
      image_.blocks[at + i] =
          to_block(CoreTriangle{triangle(part.first + i), numbers_.of_source(bvh_.order[part.first + i])},
                   scene_.bits.coord);
    image_.header.triangles += part.count;
    image_.header.most_in_leaf = std::max(image_.header.most_in_leaf, static_cast<int>(part.count));
  }

  const IntScene& scene_;
  const Bvh& bvh_;
  TriangleNumbers numbers_{scene_.mesh.mesh};
  std::vector<IntBox> boxes_;
  CoreImage image_;
};

/// Follows an image from the root down.
class ImageReader {
 public:
  explicit ImageReader(std::vector<CoreBlock> blocks) : seen_(blocks.size(), false) {
    image_.blocks = std::move(blocks);
  }

  CoreImage checked() {
    image_.header = header_of(image_.blocks);
    take(0, 0, hls::record_block);
    const CoreRecord root = record_of(image_.blocks[0]);
    if (root.counts[1] != PairChild::none) fail(0, "the root's own record has a second child");
    follow(root, 0, root.boxes.planes, 0);
    std::fill_n(seen_.begin() + 1, header_blocks, true);
    // A block without anything may make the number of blocks even.
    if (image_.blocks.back() == CoreBlock{}) seen_.back() = true;
    const auto unused = std::find(seen_.begin(), seen_.end(), false);
    if (unused != seen_.end()) fail(unused - seen_.begin(), "nothing leads to it");
    check_header("levels", levels_, image_.header.levels);
    check_header("triangles in a leaf", most_in_leaf_, image_.header.most_in_leaf);
    check_header("triangles", static_cast<std::int64_t>(numbers_.size()), image_.header.triangles);
    check_numbers();
    const Normalisation& to_cube = image_.header.to_cube;
    const glm::dvec3& offset = to_cube.offset;
    if (!std::isfinite(offset.x + offset.y + offset.z) || !std::isfinite(to_cube.scale) ||
        !(to_cube.scale > 0.0))
      throw std::runtime_error(
          fmt::format("the header has the offset ({}, {}, {}) and the scale {}; allowed are finite numbers, "
                      "and a scale above 0",
                      offset.x, offset.y, offset.z, to_cube.scale));
    return std::move(image_);
  }

 private:
  [[noreturn]] static void fail(std::ptrdiff_t block, std::string_view what) {
    throw std::runtime_error(fmt::format("block {} of the image: {}", block, what));
  }
  static void check_header(std::string_view what, std::int64_t counted, std::int64_t said) {
    if (counted != said)
      throw std::runtime_error(
          fmt::format("the image has {} {}, but its header says {}", counted, what, said));
  }
  void check_numbers() {
    std::sort(numbers_.begin(), numbers_.end());
    const auto twice = std::adjacent_find(numbers_.begin(), numbers_.end());
    if (twice != numbers_.end())
      throw std::runtime_error(fmt::format("two triangles of the image have the number {}", *twice));
    const std::uint64_t in_source = image_.header.in_source();
    if (!numbers_.empty() && numbers_.back() >= in_source)
      throw std::runtime_error(
          fmt::format("the image has a triangle {}, but its header says that the mesh has {} triangles",
                      numbers_.back(), in_source));
  }
  void take(std::uint64_t block, std::uint32_t from, hls::BlockKind kind) {
    if (block >= seen_.size()) fail(from, "a child lies outside the image");
    const auto place = static_cast<std::ptrdiff_t>(block);
    if (seen_[block]) fail(place, "two records lead to it, or a loop");
    if (kind_of(image_.blocks[block]) != hls::kind_byte(kind, image_.header.coord_bits))
      fail(place, fmt::format("it is no {} of this grid", kind == hls::record_block ? "record" : "triangle"));
    seen_[block] = true;
  }

  /// A core reads n bits of a plane, so one outside the cube would be another plane.
  void check_record(std::uint32_t block, const CoreRecord& record) const {
    if (to_block(record, image_.header.coord_bits) != image_.blocks[block])
      fail(block, "bits of a record that have no meaning are not 0");
    const auto most = static_cast<std::int32_t>(grid_scale(image_.header.coord_bits));
    const auto outside = [&](std::int32_t plane) { return plane < -most || plane > most; };
    const IntBox& planes = record.boxes.planes;
    if (std::any_of(planes.min.begin(), planes.min.end(), outside) ||
        std::any_of(planes.max.begin(), planes.max.end(), outside))
      fail(block, "a plane lies outside the cube");
  }

  void follow(const CoreRecord& record, std::uint32_t block, const IntBox& common, int level) {
    if (level >= CoreImage::most_levels) fail(block, "more than 60 records on a path");
    check_record(block, record);
    levels_ = std::max(levels_, level + 1);
    ++image_.records;
    const std::array<IntBox, 2> boxes = boxes_in(record.boxes, common);
    std::uint64_t at = record.pointer;
    for (unsigned which = 0; which < 2; ++which) {
      const std::int32_t count = record.counts[which];
      if (count == PairChild::none) continue;
      if (!holds(common, boxes[which])) fail(block, "a child's box is not inside its parent's");
      if (count != PairChild::branch) most_in_leaf_ = std::max(most_in_leaf_, count);
      const std::uint32_t taken = count == PairChild::branch ? 1 : static_cast<std::uint32_t>(count);
      for (std::uint32_t i = 0; i < taken; ++i) {
        take(at + i, block, count == PairChild::branch ? hls::record_block : hls::triangle_block);
        if (count != PairChild::branch) check_triangle(static_cast<std::uint32_t>(at + i), boxes[which]);
      }
      if (count == PairChild::branch) {
        const auto below = static_cast<std::uint32_t>(at);
        follow(record_of(image_.blocks[below]), below, boxes[which], level + 1);
      }
      at += taken;
    }
  }
  void check_triangle(std::uint32_t block, const IntBox& box) {
    const CoreTriangle triangle = triangle_of(image_.blocks[block]);
    if (triangle.number == IntHit::none) fail(block, "a triangle with the number of none");
    const IntBox own = box_of(triangle.triangle);
    if (!holds(box, own)) fail(block, "its leaf's box does not hold the triangle whole");
    if (is_degenerate(triangle.triangle)) fail(block, "a triangle without area");
    numbers_.push_back(triangle.number);
  }

  CoreImage image_;
  std::vector<bool> seen_;
  int levels_ = 0, most_in_leaf_ = 0;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace

PairChild CoreRecord::child(unsigned which) const {
  const std::int32_t before = which == 0 ? 0 : std::max(counts[0], counts[0] == PairChild::branch ? 1 : 0);
  return {counts[which], pointer + static_cast<std::uint32_t>(before)};
}

CoreBlock to_block(const CoreRecord& record, int coord_bits) {
  CoreBlock block{};
  put_kind(block, hls::record_block, coord_bits);
  for (unsigned axis = 0; axis < 3; ++axis) {
    put_coordinate(block, axis, record.boxes.planes.min[axis]);
    put_coordinate(block, axis + 3, record.boxes.planes.max[axis]);
  }
  put(block, owners_at, owner_bits, record.boxes.owners);
  put(block, pointer_at, 32, record.pointer);
  for (unsigned which = 0; which < 2; ++which) {
    const std::int32_t count = record.counts[which];
    put(block, counts_at + which * count_bits, count_bits,
        count == PairChild::none     ? 0
        : count == PairChild::branch ? count_of_branch
                                     : static_cast<std::uint64_t>(count));
  }
  return block;
}

CoreRecord record_of(const CoreBlock& block) {
  CoreRecord record;
  for (unsigned axis = 0; axis < 3; ++axis) {
    record.boxes.planes.min[axis] = coordinate(block, axis);
    record.boxes.planes.max[axis] = coordinate(block, axis + 3);
  }
  record.boxes.owners = static_cast<std::uint8_t>(get(block, owners_at, owner_bits));
  record.pointer = static_cast<std::uint32_t>(get(block, pointer_at, 32));
  for (unsigned which = 0; which < 2; ++which) {
    const std::uint64_t count = get(block, counts_at + which * count_bits, count_bits);
    record.counts[which] = count == 0                 ? PairChild::none
                           : count == count_of_branch ? PairChild::branch
                                                      : static_cast<std::int32_t>(count);
  }
  return record;
}

CoreBlock to_block(const CoreTriangle& triangle, int coord_bits) {
  CoreBlock block{};
  put_kind(block, hls::triangle_block, coord_bits);
  for (unsigned corner = 0; corner < 3; ++corner)
    for (unsigned axis = 0; axis < 3; ++axis)
      put_coordinate(block, 3 * corner + axis, triangle.triangle.corners[corner][axis]);
  put(block, number_at, 32, triangle.number);
  return block;
}

CoreTriangle triangle_of(const CoreBlock& block) {
  CoreTriangle triangle;
  for (unsigned corner = 0; corner < 3; ++corner)
    for (unsigned axis = 0; axis < 3; ++axis)
      triangle.triangle.corners[corner][axis] = coordinate(block, 3 * corner + axis);
  triangle.number = static_cast<std::uint32_t>(get(block, number_at, 32));
  return triangle;
}

CoreImage core_image(const IntScene& scene) {
  CoreImage image;
  if (scene.bvh) {
    image = ImageWriter(scene).written();
  } else {
    constexpr std::uint32_t behind = 1 + header_blocks;
    image.blocks.resize(behind);
    image.blocks[0] = to_block(CoreRecord{.boxes = {}, .pointer = behind}, scene.bits.coord);
    image.records = 1;
    image.header.levels = 1;
  }
  image.blocks.resize(image.blocks.size() + image.blocks.size() % 2);
  image.header.coord_bits = scene.bits.coord;
  image.header.missing = static_cast<std::uint32_t>(scene.mesh.mesh.dropped.size());
  image.header.to_cube = scene.scene.to_cube;
  put_header(image.blocks, image.header);
  return image;
}

CoreImage checked_image(std::vector<CoreBlock> blocks) {
  return ImageReader(std::move(blocks)).checked();
}

}  // namespace hitpipe::ref
