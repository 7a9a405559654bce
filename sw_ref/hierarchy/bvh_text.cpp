#include "sw_ref/hierarchy/bvh_text.hpp"

#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "sw_ref/scene/triangle_numbers.hpp"

namespace hitpipe::ref {

std::string bvh_text(const Bvh& bvh, const Mesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "hitpipe-bvh 1\nspace cube\nnodes {}\n", bvh.nodes.size());
  for (const BvhNode& node : bvh.nodes) {
    const Aabb& box = node.box;
    fmt::format_to(out, "{} {} {} {} {} {} {} {} ", node.is_leaf() ? "leaf" : "branch", box.min.x, box.min.y,
                   box.min.z, box.max.x, box.max.y, box.max.z, node.first);
    if (node.is_leaf()) {
      fmt::format_to(out, "{}\n", node.count);
    } else {
      fmt::format_to(out, "{} split {}\n", node.first + 1, "xyz"[node.split_axis()]);
    }
  }
  fmt::format_to(out, "triangles {}\n", bvh.order.size());
  const TriangleNumbers numbers(mesh);
  constexpr std::size_t a_line = 10;
  for (std::size_t i = 0; i < bvh.order.size(); ++i) {
    const bool last = (i + 1) % a_line == 0 || i + 1 == bvh.order.size();
    fmt::format_to(out, "{}{}", numbers.of_source(bvh.order[i]), last ? '\n' : ' ');
  }
  return text;
}

}  // namespace hitpipe::ref
