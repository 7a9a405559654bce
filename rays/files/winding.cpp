// A sweep after Shamos and Hoey (1976) from left to right, at equal x from below. Between two neighbours
// among the edges that it meets, the winding number is known.
#include "rays/files/winding.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include "rays/mesh/orientation.hpp"

namespace hitpipe::ref {
namespace {

bool before(const glm::dvec2& p, const glm::dvec2& q) {
  return p.x < q.x || (p.x == q.x && p.y < q.y);
}

struct SweptEdge {
  glm::dvec2 left;
  glm::dvec2 right;
  int step;       // of the winding number, from below the edge to above it
  int above = 0;  // winding number there

  /// 1 if the point lies above.
  [[nodiscard]] int side(const glm::dvec2& p) const { return orientation(left, right, p); }
};

class Sweep {
 public:
  explicit Sweep(std::span<const glm::dvec2> corners) : met_(Order{&edges_}) {
    const std::size_t n = corners.size();
    edges_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const glm::dvec2& p = corners[i];
      const glm::dvec2& q = corners[i + 1 == n ? 0 : i + 1];
      edges_.push_back(before(p, q) ? SweptEdge{p, q, 1} : SweptEdge{q, p, -1});
    }
    places_.resize(n, met_.end());
  }

  Winding run(std::span<const glm::dvec2> corners) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return before(corners[i], corners[j]) || (corners[i] == corners[j] && i < j);
    });
    for (std::size_t first = 0, end = 0; first < n; first = end) {
      const glm::dvec2& point = corners[order[first]];
      at_point_.clear();
      for (; end < n && corners[order[end]] == point; ++end) {
        const std::uint32_t corner = order[end];
        for (const std::uint32_t edge : {corner, (corner == 0 ? n : corner) - 1})
          if (edges_[edge].left != edges_[edge].right) at_point_.push_back(edge);
      }
      if (!pass(point)) return Winding::crossing;
      if (through_ > most_through_corner) return Winding::crowded;
    }
    if (lowest_ == 0 && highest_ == 0) return Winding::none;
    if (lowest_ == 0 && highest_ == 1) return Winding::left;
    if (lowest_ == -1 && highest_ == 0) return Winding::right;
    return Winding::crossing;
  }

 private:
  struct Order {
    const std::vector<SweptEdge>* edges;
    bool operator()(std::uint32_t i, std::uint32_t j) const {
      const SweptEdge& a = (*edges)[i];
      const SweptEdge& b = (*edges)[j];
      int up = 0;  // of b over a
      if (before(b.left, a.left)) {
        up = -b.side(a.left);
        if (up == 0) up = -b.side(a.right);
      } else {
        up = a.side(b.left);
        if (up == 0) up = a.side(b.right);
      }
      return up != 0 ? up > 0 : i < j;
    }
  };
  using Met = std::set<std::uint32_t, Order>;

  [[nodiscard]] bool cross(std::uint32_t i, std::uint32_t j) const {
    const SweptEdge& a = edges_[i];
    const SweptEdge& b = edges_[j];
    return a.side(b.left) * a.side(b.right) < 0 && b.side(a.left) * b.side(a.right) < 0;
  }

  [[nodiscard]] bool crosses_neighbour(Met::iterator place) const {
    const auto next = std::next(place);
    return (place != met_.begin() && cross(*std::prev(place), *place)) ||
           (next != met_.end() && cross(*place, *next));
  }

  /// Ends and begins the edges at a point. False if two edges cross.
  bool pass(const glm::dvec2& point) {
    auto upper = met_.end();  // an edge through the point, or the next above it
    for (const std::uint32_t edge : at_point_) {
      if (edges_[edge].right != point) continue;
      upper = met_.erase(places_[edge]);
      if (upper != met_.end() && crosses_neighbour(upper)) return false;
    }
    for (const std::uint32_t edge : at_point_) {
      if (edges_[edge].left != point) continue;
      upper = places_[edge] = met_.insert(edge).first;
      if (crosses_neighbour(upper)) return false;
    }
    count_from(upper, point);
    return true;
  }

  void count_from(Met::iterator place, const glm::dvec2& point) {
    through_ = 0;
    while (place != met_.begin() && edges_[*std::prev(place)].side(point) == 0) --place;
    int number = place == met_.begin() ? 0 : edges_[*std::prev(place)].above;
    for (; place != met_.end() && edges_[*place].side(point) == 0; ++place) {
      SweptEdge& edge = edges_[*place];
      through_ += static_cast<int>(edge.left != point);
      edge.above = number += edge.step;
      const auto next = std::next(place);
      const bool overlap = next != met_.end() && edges_[*next].side(point) == 0 &&
                           edge.side(edges_[*next].right) == 0;  // no area lies between them
      if (overlap) continue;
      lowest_ = std::min(lowest_, number);
      highest_ = std::max(highest_, number);
    }
  }

  std::vector<SweptEdge> edges_;
  Met met_;
  std::vector<Met::iterator> places_;
  std::vector<std::uint32_t> at_point_;
  int lowest_ = 0;
  int highest_ = 0;
  int through_ = 0;  // edges through the last point that do not begin there
};

}  // namespace

Winding winding(std::span<const glm::dvec2> corners) {
  return Sweep(corners).run(corners);
}

}  // namespace hitpipe::ref
