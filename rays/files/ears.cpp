// An ear is a corner whose triangle with its two neighbours lies in the polygon: no edge runs through the
// triangle, and it is covered once. Only bent corners need to be looked at: reflex ones and those where the
// walk turns back. If an edge runs through the triangle, such a corner is in it. Proof: of the part in the
// triangle, take the corner farthest from the cut. The polygon lies on its far side.
#include "rays/files/ears.hpp"

#include <algorithm>
#include <queue>

#include "rays/files/corner_grid.hpp"
#include "rays/mesh/orientation.hpp"

namespace hitpipe::ref {
namespace {

/// What a cut of a corner is worth; the least comes first.
enum Worth : std::uint8_t {
  spike,      ///< without area, and the walk turns back
  clean,      ///< an ear
  touching,   ///< an ear whose cut has another corner on it
  straight,   ///< without area, and the walk goes straight on; other cuts use the corner better
  forbidden,  ///< not convex, or no ear
};

class EarCutter {
 public:
  /// Careful: edges that are walked twice may hide that a triangle is not covered, so count. This takes time,
  /// and few polygons need it.
  EarCutter(std::span<const glm::dvec2> corners, bool careful)
      : points_(corners), links_(corners.size()), left_(static_cast<std::uint32_t>(corners.size())) {
    for (std::uint32_t i = 0; i < left_; ++i)
      links_[i] = {i == 0 ? left_ - 1 : i - 1, i + 1 == left_ ? 0 : i + 1};
    if (careful) mark_shared();
    std::vector<std::uint32_t> bent;
    for (std::uint32_t i = 0; i < left_; ++i)
      if (look(i)) bent.push_back(i);
    grid_ = CornerGrid(points_, bent);
  }

  bool run(std::vector<std::array<std::uint32_t, 3>>& triangles) {
    while (left_ > 2) {
      if (queue_.empty() && !look_again()) return false;
      const Candidate top = queue_.top();
      queue_.pop();
      Link& corner = links_[top.corner];
      if (corner.gone || top.version != corner.version) continue;
      Worth worth = top.worth;
      if (worth == clean) worth = test(top.corner);
      if (worth == forbidden) continue;
      if (worth != top.worth) {
        queue_.push({worth, top.length, top.corner, top.version});
        continue;
      }
      if (worth == touching && test(top.corner) == forbidden) continue;
      triangles.push_back({corner.before, top.corner, corner.after});
      cut(top.corner);
    }
    return true;
  }

 private:
  struct Link {
    std::uint32_t before = 0;
    std::uint32_t after = 0;
    std::uint32_t version = 0;
    bool gone = false;
    bool bent = false;    // reflex, or a spike
    bool shared = false;  // another corner of the polygon has the same place
  };
  struct Candidate {
    Worth worth;
    double length;  // of the cut, squared: short cuts leave few corners inside later triangles
    std::uint32_t corner;
    std::uint32_t version;
    bool operator<(const Candidate& other) const {  // the greatest comes first
      if (worth != other.worth) return worth > other.worth;
      if (length != other.length) return length > other.length;
      return corner > other.corner;
    }
  };

  void mark_shared() {
    std::vector<std::uint32_t> order(links_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return points_[i].x < points_[j].x || (points_[i].x == points_[j].x && points_[i].y < points_[j].y);
    });
    for (std::size_t k = 1; k < order.size(); ++k)
      if (points_[order[k - 1]] == points_[order[k]])
        links_[order[k - 1]].shared = links_[order[k]].shared = true;
  }

  [[nodiscard]] static bool goes_straight(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (a.x < b.x && b.x < c.x) || (a.x > b.x && b.x > c.x) || (a.y < b.y && b.y < c.y) ||
           (a.y > b.y && b.y > c.y);
  }

  /// Makes the corner a candidate, unless it is reflex. Returns whether it is bent.
  bool look(std::uint32_t i) {
    Link& corner = links_[i];
    const glm::dvec2& a = points_[corner.before];
    const glm::dvec2& b = points_[i];
    const glm::dvec2& c = points_[corner.after];
    const int turn = orientation(a, b, c);
    const Worth worth = turn < 0 ? forbidden : turn > 0 ? clean : goes_straight(a, b, c) ? straight : spike;
    corner.bent = worth == forbidden || worth == spike;
    ++corner.version;
    if (worth == forbidden) return true;
    const glm::dvec2 cut = c - a;
    queue_.push({worth, cut.x * cut.x + cut.y * cut.y, i, corner.version});
    return corner.bent;
  }

  void cut(std::uint32_t i) {
    Link& corner = links_[i];
    corner.gone = true;
    links_[corner.before].after = corner.after;
    links_[corner.after].before = corner.before;
    --left_;
    cut_since_look_ = true;
    for (const std::uint32_t neighbour : {corner.before, corner.after})
      if (look(neighbour)) grid_.put_back(neighbour);
  }

  /// After a spike is cut, corners that were no ears can be some. False if nothing was cut since the last
  /// look.
  bool look_again() {
    if (!cut_since_look_) return false;
    cut_since_look_ = false;
    for (std::uint32_t i = 0; i < links_.size(); ++i)
      if (!links_[i].gone) (void)look(i);
    return !queue_.empty();
  }

  [[nodiscard]] Worth test(std::uint32_t i) {
    const Link& corner = links_[i];
    const glm::dvec2& a = points_[corner.before];
    const glm::dvec2& b = points_[i];
    const glm::dvec2& c = points_[corner.after];
    const auto is_on_cut = [&](std::uint32_t next) {
      return orientation(a, c, points_[next]) == 0 && goes_straight(a, points_[next], c);
    };
    Worth worth =
        is_on_cut(links_[corner.before].before) || is_on_cut(links_[corner.after].after) ? touching : clean;
    const bool free =
        grid_.visit(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), [&](std::uint32_t other) {
          if (other == i || other == corner.before || other == corner.after) return CornerGrid::keep;
          if (links_[other].gone || !links_[other].bent) return CornerGrid::remove;
          return blocks(a, b, c, other, worth) ? CornerGrid::stop : CornerGrid::keep;
        });
    if (!free || (corner.shared && !covered_at(i))) return forbidden;
    return worth;
  }

  /// Whether the corner, or an edge from it, lies in the open triangle.
  [[nodiscard]] bool blocks(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                            std::uint32_t other, Worth& worth) const {
    const glm::dvec2& p = points_[other];
    const int ab = orientation(a, b, p);
    if (ab < 0) return false;
    const int bc = orientation(b, c, p);
    if (bc < 0) return false;
    const int ca = orientation(c, a, p);
    if (ca < 0) return false;
    if (ca == 0 && ab > 0 && bc > 0) worth = touching;
    for (const std::uint32_t end : {links_[other].before, links_[other].after}) {
      const glm::dvec2& q = points_[end];
      if (q == p) continue;
      if ((ab > 0 || orientation(a, b, q) > 0) && (bc > 0 || orientation(b, c, q) > 0) &&
          (ca > 0 || orientation(c, a, q) > 0))
        return true;
    }
    return false;
  }

  /// Whether the winding number of what is left is 1 just inside a convex corner. Edges that are walked twice
  /// can cancel there. The ray upwards from b + e (a - b) + e^2 (c - b), with e as small as you like, is
  /// crossed by edges; if the edge to a is vertical, a and c change their parts.
  [[nodiscard]] bool covered_at(std::uint32_t i) const {
    const glm::dvec2& b = points_[i];
    const glm::dvec2* near = &points_[links_[i].before];
    const glm::dvec2* far = &points_[links_[i].after];
    if (near->x == b.x) std::swap(near, far);
    const bool moves_right = near->x > b.x;
    const auto is_left = [&](const glm::dvec2& p) { return p.x < b.x || (p.x == b.x && moves_right); };
    int number = 0;
    std::uint32_t from = i;
    do {
      const std::uint32_t to = links_[from].after;
      const glm::dvec2* s = &points_[from];
      const glm::dvec2* t = &points_[to];
      from = to;
      if (is_left(*s) == is_left(*t)) continue;
      const bool rightward = is_left(*s);
      if (!rightward) std::swap(s, t);
      int side = orientation(*s, *t, b);
      if (side == 0) side = orientation(*s, *t, *near);
      if (side == 0) side = orientation(*s, *t, *far);
      if (side < 0) number += rightward ? -1 : 1;
    } while (from != i);
    return number == 1;
  }

  std::span<const glm::dvec2> points_;
  std::vector<Link> links_;
  std::uint32_t left_;
  std::priority_queue<Candidate> queue_;
  CornerGrid grid_;
  bool cut_since_look_ = true;
};

}  // namespace

bool cut_ears(std::span<const glm::dvec2> corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const std::size_t start = triangles.size();
  for (const bool careful : {false, true}) {
    if (EarCutter(corners, careful).run(triangles)) return true;
    triangles.resize(start);
  }
  return false;
}

}  // namespace hitpipe::ref
