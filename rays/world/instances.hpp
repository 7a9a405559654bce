// Meshes of the integer world and their instances (docs/instances.md). What they answer is what one flattened mesh
// would answer: all instances' triangles, moved and rounded, one behind the other. It is defined, and never built.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hls/world/world_format.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/box_cover.hpp"
#include "rays/world/grid_map.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/object_space.hpp"

namespace hitpipe::ref {

/// A mesh that instances show. Triangles that are flat on its own grid are there, as an instance rounds their corners
/// and may give them an area.
class IntObject {
 public:
  /// At least one triangle; coordinates of up to 23 bits and a sign.
  IntObject(std::vector<IntTriangle> triangles, const BuildOptions& options);

  [[nodiscard]] std::span<const IntTriangle> triangles() const { return triangles_; }
  [[nodiscard]] const Bvh& bvh() const { return bvh_; }
  /// By node of the hierarchy.
  [[nodiscard]] std::span<const IntBox> boxes() const { return boxes_; }
  /// |coordinate| by axis.
  [[nodiscard]] const std::array<std::int32_t, 3>& most() const { return most_; }

  /// Of what is below the node.
  [[nodiscard]] BoxCover cover(std::uint32_t node) const;
  /// Of the root.
  [[nodiscard]] const BoxCover& cover() const { return *cover_; }

 private:
  std::vector<IntTriangle> triangles_;
  Bvh bvh_;
  std::vector<IntBox> boxes_;
  std::array<std::int32_t, 3> most_{};
  std::optional<BoxCover> cover_;
};

/// A mesh somewhere in the world.
struct IntInstance {
  static constexpr std::uint8_t all_masks = 0xff;

  std::uint32_t mesh = 0;
  GridMap map;
  std::uint8_t mask = all_masks;  ///< a ray meets it if they have a bit in common
};

/// Thread-safe, but for place().
class IntInstances {
 public:
  /// Instance i, and triangle k of its mesh.
  struct Part {
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
  };

  /// An instance, or a part of a large one: what is below a node of its mesh's hierarchy. Its space has a box that holds
  /// the part's corners, and may be larger.
  struct Entry {
    std::uint32_t instance = 0;
    std::uint32_t node = 0;
    ObjectSpace space;
  };

  /// Throws std::out_of_range, one line that names the instance, where one leaves the grid or its mesh is too large for
  /// its own (object_space()), and std::invalid_argument for a mesh that is not there or 2^32 - 1 triangles and more.
  IntInstances(std::vector<IntObject> meshes, std::vector<IntInstance> instances, const hls::WorldBits& bits,
               const BuildOptions& options);

  /// New places for the instances from `first` on. The hierarchy over them stays, and its boxes follow; entries that
  /// have moved are added to `moved`. Throws as the constructor, and then nothing has changed.
  void place(std::uint32_t first, std::vector<GridMap> maps, std::vector<std::uint32_t>& moved);

  [[nodiscard]] const hls::WorldBits& bits() const { return bits_; }
  [[nodiscard]] std::span<const IntObject> meshes() const { return meshes_; }
  [[nodiscard]] std::span<const IntInstance> instances() const { return instances_; }
  [[nodiscard]] const IntObject& mesh_of(std::uint32_t instance) const {
    return meshes_[instances_[instance].mesh];
  }
  /// The number of the instance's first triangle: all of those before it are its mesh's, in order.
  [[nodiscard]] std::uint32_t base(std::uint32_t instance) const { return bases_[instance]; }
  /// Triangles of the flattened mesh.
  [[nodiscard]] std::uint32_t triangle_count() const { return bases_.back(); }
  [[nodiscard]] Part part(std::uint32_t number) const;
  /// A triangle of an instance as it lies in the world. Where the map mirrors, corners 1 and 2 are exchanged, as glTF
  /// has it for mirrored nodes: what is outside of the mesh stays outside.
  [[nodiscard]] IntTriangle triangle(std::uint32_t instance, std::uint32_t triangle) const;
  /// Of the flattened mesh.
  [[nodiscard]] IntTriangle triangle(std::uint32_t number) const {
    const Part place = part(number);
    return triangle(place.instance, place.triangle);
  }

  /// What the leaves of top() have.
  [[nodiscard]] std::span<const Entry> entries() const { return entries_; }
  /// Over the entries: Bvh::order has their numbers. Without an instance it has no node.
  [[nodiscard]] const Bvh& top() const { return top_; }
  /// By node of top().
  [[nodiscard]] std::span<const IntBox> top_boxes() const { return top_boxes_; }
  /// The box of the leaf of top() that has the entry.
  [[nodiscard]] const IntBox& leaf_box(std::uint32_t entry) const { return top_boxes_[leaves_[entry]]; }

 private:
  hls::WorldBits bits_;
  std::vector<IntObject> meshes_;
  std::vector<IntInstance> instances_;
  std::vector<std::uint8_t> mirrors_;
  std::vector<std::uint32_t> bases_;  ///< and the number of all triangles
  /// The space of what is below the node of the instance's mesh, where the map puts it.
  [[nodiscard]] ObjectSpace space_of(std::uint32_t instance, std::uint32_t node, const GridMap& map) const;
  void open_large();
  /// Of a node of top(), by what is below it.
  [[nodiscard]] IntBox box_of(std::uint32_t node) const;
  /// Of all nodes of top().
  void make_top_boxes();
  /// The spaces of these entries, for the instances' maps.
  void make_spaces(std::size_t first, std::size_t last);

  std::vector<Entry> entries_;  ///< by instance
  Bvh top_;
  std::vector<IntBox> top_boxes_;
  std::vector<std::uint32_t> parents_;  ///< by node of top()
  std::vector<std::uint32_t> leaves_;   ///< by entry: its node of top()
};

/// The mesh that defines the answers.
[[nodiscard]] std::vector<IntTriangle> flattened(const IntInstances& world);

}  // namespace hitpipe::ref
