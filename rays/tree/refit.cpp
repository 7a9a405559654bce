#include "rays/tree/refit.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace hitpipe::ref {

namespace {

class Refit {
 public:
  Refit(const Bvh& bvh, const Mesh& mesh, std::span<const std::uint32_t> numbers)
      : old_(bvh), mesh_(mesh), numbers_(numbers), kept_(bvh.nodes.size()), found_(mesh.triangles.size()) {}

  Bvh make() {
    // Children come after their parents.
    for (std::size_t i = old_.nodes.size(); i-- > 0;) kept_[i] = keeps(old_.nodes[i]);
    made_.nodes.emplace_back();
    if (kept_[0]) put(0, 0, 1);
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (!found_[i]) throw std::invalid_argument(fmt::format("triangle {} is in no leaf", i));
    return std::move(made_);
  }

 private:
  [[nodiscard]] std::optional<std::uint32_t> renumbered(std::uint32_t triangle) const {
    const auto at = std::lower_bound(numbers_.begin(), numbers_.end(), triangle);
    if (at == numbers_.end() || *at != triangle) return std::nullopt;
    return static_cast<std::uint32_t>(at - numbers_.begin());
  }
  [[nodiscard]] std::span<const std::uint32_t> triangles_of(const BvhNode& leaf) const {
    return std::span(old_.order).subspan(leaf.first, static_cast<std::size_t>(leaf.count));
  }
  [[nodiscard]] bool keeps(const BvhNode& node) const {
    if (!node.is_leaf()) return kept_[node.first] || kept_[node.first + 1];
    const auto triangles = triangles_of(node);
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](std::uint32_t triangle) { return renumbered(triangle).has_value(); });
  }

  /// Makes node `from` at `place`. Recursion is no deeper than the hierarchy, BuildOptions::deepest.
  void put(std::size_t from, std::size_t place, int level) {
    const BvhNode* node = &old_.nodes[from];
    while (!node->is_leaf() && !(kept_[node->first] && kept_[node->first + 1]))
      node = &old_.nodes[node->first + (kept_[node->first] ? 0 : 1)];
    if (node->is_leaf()) return put_leaf(*node, place, level);
    const auto child = static_cast<std::uint32_t>(made_.nodes.size());
    made_.nodes.resize(made_.nodes.size() + 2);
    put(node->first, child, level + 1);
    put(node->first + 1, child + 1, level + 1);
    Aabb box = made_.nodes[child].box;
    box.grow(made_.nodes[child + 1].box);
    made_.nodes[place] = {box, node->count, child};
  }
  void put_leaf(const BvhNode& leaf, std::size_t place, int level) {
    BvhNode made{.box = {}, .count = 0, .first = static_cast<std::uint32_t>(made_.order.size())};
    for (const std::uint32_t triangle : triangles_of(leaf)) {
      const std::optional<std::uint32_t> number = renumbered(triangle);
      if (!number) continue;
      found_[*number] = true;
      made_.order.push_back(*number);
      made.count += 1;
      for (int corner = 0; corner < 3; ++corner)
        made.box.grow(mesh_.vertices[mesh_.triangles[*number][corner]]);
    }
    made_.nodes[place] = made;
    made_.depth = std::max(made_.depth, level);
  }

  const Bvh& old_;
  const Mesh& mesh_;
  std::span<const std::uint32_t> numbers_;
  std::vector<bool> kept_;   ///< by old node: a triangle of the mesh is below it
  std::vector<bool> found_;  ///< by triangle of the mesh
  Bvh made_;
};

}  // namespace

Bvh refitted(const Bvh& bvh, const Mesh& mesh, std::span<const std::uint32_t> numbers) {
  return Refit(bvh, mesh, numbers).make();
}

}  // namespace hitpipe::ref
