#include "rtl_gen/emit/port_vectors.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "rtl_gen/emit/shown_bits.hpp"

namespace hitpipe::rtl {

namespace {

// Of 16 vectors so many are at corners, as many beside a hit at corners, and so many beside any hit. The rest
// is at the border.
constexpr std::size_t of_corners = 4;
constexpr std::size_t of_any = 1;

constexpr std::size_t most_rare_draws = 48'000;
constexpr std::size_t most_starts = 32;  ///< vectors beside which rare ones are sought: the last found

}  // namespace

PortVectors::PortVectors(const VectorUnit& unit, std::uint64_t seed)
    : unit_(unit),
      draw_(unit.ports, unit.demands),
      border_(draw_, unit.evaluate, unit.results),
      random_(seed) {
  constexpr int most_tries = 10'000;
  for (int tries = 0; tries < most_tries && any_hit_.empty(); ++tries) static_cast<void>(any());
  for (int tries = 0; tries < most_tries && corner_hit_.empty(); ++tries) static_cast<void>(corners());
}

Vector PortVectors::noted(LastHit& last, std::vector<std::int64_t> operands) const {
  Vector vector = judged(std::move(operands), unit_.evaluate);
  if (unit_.evaluate.hit(vector.results.data())) last = vector.operands;
  return vector;
}

Vector PortVectors::beside_any() {
  return any_hit_.empty() ? any() : noted(any_hit_, draw_.beside(any_hit_, random_));
}

Vector PortVectors::beside_corners() {
  return corner_hit_.empty() ? corners() : noted(corner_hit_, draw_.corners_beside(corner_hit_, random_));
}

std::vector<Vector> PortVectors::borders(std::size_t count) {
  std::vector<Vector> vectors;
  for (std::size_t tries = 0; vectors.size() < count; ++tries) {
    Vector from = tries % 8 == 0 ? any() : tries % 2 == 0 ? beside_any() : beside_corners();
    std::vector<Vector> near = border(from.operands);
    if (near.empty()) near.push_back(std::move(from));
    for (Vector& each : near)
      if (vectors.size() < count) vectors.push_back(std::move(each));
  }
  return vectors;
}

std::vector<Vector> PortVectors::beside_found(const std::vector<Vector>& found, std::size_t count) {
  std::vector<Vector> vectors;
  while (vectors.size() < count) {
    const std::size_t back = random_() % std::min(found.size(), most_starts);
    const std::vector<std::int64_t>& start = found[found.size() - 1 - back].operands;
    Vector beside =
        judged(random_() % 4 == 0 ? draw_.beside(start, random_) : draw_.corners_beside(start, random_),
               unit_.evaluate);
    std::vector<Vector> near = border(beside.operands);
    vectors.push_back(std::move(beside));
    for (Vector& each : near)
      if (vectors.size() < count) vectors.push_back(std::move(each));
  }
  return vectors;
}

std::vector<VectorGroup> PortVectors::groups(std::size_t count) {
  std::vector<VectorGroup> groups{
      {"corners", {}}, {"beside_corners", {}}, {"beside_hits", {}}, {"border", {}}};
  const std::size_t corners_share = count * of_corners / 16;
  const std::size_t any_share = count * of_any / 16;
  while (groups[0].vectors.size() < corners_share) groups[0].vectors.push_back(corners());
  while (groups[1].vectors.size() < corners_share) groups[1].vectors.push_back(beside_corners());
  while (groups[2].vectors.size() < any_share) groups[2].vectors.push_back(beside_any());
  groups[3].vectors = borders(count - 2 * corners_share - any_share);
  return groups;
}

VectorGroup PortVectors::rare(const std::vector<VectorGroup>& groups, std::size_t count) {
  VectorGroup rare{"rare_bits", {}};
  // The logic of a float operator is too long to be run for each of its bits.
  if (unit_.graph.units().empty()) {
    ShownBits shown(unit_.graph, unit_.ports);
    for (const VectorGroup& group : groups) {
      const std::span<const Vector> all(group.vectors);
      for (std::size_t i = 0; i < all.size(); i += most_lanes)
        static_cast<void>(shown.new_ones(all.subspan(i, std::min(most_lanes, all.size() - i))));
    }
    for (std::size_t drawn = 0; drawn < most_rare_draws && rare.vectors.size() < count && shown.hidden() > 0;
         drawn += most_lanes) {
      const bool go_on = !rare.vectors.empty() && random_() % 2 == 0;
      const std::vector<Vector> draws = go_on ? beside_found(rare.vectors, most_lanes) : borders(most_lanes);
      for (Vector& each : shown.new_ones(draws)) rare.vectors.push_back(std::move(each));
    }
    rare.vectors.resize(std::min(rare.vectors.size(), count));
  }
  for (Vector& each : borders(count - rare.vectors.size())) rare.vectors.push_back(std::move(each));
  return rare;
}

}  // namespace hitpipe::rtl
