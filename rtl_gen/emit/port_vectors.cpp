#include "rtl_gen/emit/port_vectors.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace hitpipe::rtl {

namespace {

constexpr int most_ports = 4;  ///< for which one search looks for the border
constexpr int most_ways = 16;  ///< tried from one place
constexpr int most_bits = 3;   ///< tried for one vector with a bit changed, and such vectors on either side

}  // namespace

Border::Border(const Draw& draw, const Evaluate& evaluate, const std::vector<hls::Result>& results)
    : draw_(draw), evaluate_(evaluate) {
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].width == 1) answers_.push_back(i);
}

std::optional<Border::Way> Border::way_across(const Vector& here, std::mt19937_64& random) const {
  const std::vector<std::size_t>& ports = draw_.free_ports();
  for (int tries = 0; tries < most_ways && !ports.empty(); ++tries) {
    const std::size_t port = ports[random() % ports.size()];
    std::vector<std::int64_t> operands = here.operands;
    operands[port] = draw_.another(operands, port, random);
    if (!draw_.meets_all(operands)) continue;
    Vector there = with_results(std::move(operands), evaluate_);
    for (const std::size_t answer : answers_)
      if (there.results[answer] != here.results[answer]) return Way{here, std::move(there), port, answer};
  }
  return std::nullopt;
}

bool Border::shorten(Way& way) const {
  while (true) {
    const std::int64_t from = way.here.operands[way.port];
    const std::int64_t middle = draw_.halfway(way.port, from, way.there.operands[way.port]);
    if (middle == from) return true;
    std::vector<std::int64_t> operands = way.here.operands;
    operands[way.port] = middle;
    if (!draw_.meets_all(operands)) return false;
    Vector between = with_results(std::move(operands), evaluate_);
    const bool is_here = between.results[way.answer] == way.here.results[way.answer];
    (is_here ? way.here : way.there) = std::move(between);
  }
}

std::optional<Vector> Border::bit_across(const Vector& from, const Vector& as, const Way& way,
                                         std::mt19937_64& random) const {
  for (int tries = 0; tries < most_bits; ++tries) {
    std::vector<std::int64_t> operands = from.operands;
    operands[way.port] = draw_.one_bit_changed(operands[way.port], way.port, random);
    if (operands == as.operands || !draw_.meets_all(operands)) continue;
    Vector changed = with_results(std::move(operands), evaluate_);
    if (changed.results[way.answer] == as.results[way.answer]) return changed;
  }
  return std::nullopt;
}

std::vector<Vector> Border::near(const std::vector<std::int64_t>& operands, std::mt19937_64& random) const {
  std::optional<Way> found;
  Vector here = with_results(operands, evaluate_);
  for (auto ports = 1 + random() % most_ports; ports > 0; --ports) {
    std::optional<Way> way = way_across(here, random);
    if (!way || !shorten(*way)) break;
    here = way->here;
    found = std::move(way);
  }
  if (!found) return {};
  std::vector<Vector> vectors{found->here, found->there};
  const auto add = [&](const Vector& from, const Vector& as) {
    if (std::optional<Vector> changed = bit_across(from, as, *found, random))
      vectors.push_back(std::move(*changed));
  };
  for (int i = 0; i < most_bits; ++i) {
    add(found->there, found->here);
    add(found->here, found->there);
  }
  return vectors;
}

ShownBits::ShownBits(const Graph& graph, const std::vector<Port>& ports) : lanes_(graph) {
  for (const NodeId id : graph.inputs()) places_.push_back(index_of(ports, graph[id].name).value());
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (graph[id].op == Op::constant) continue;
    for (int bit = 0; bit < graph[id].width; ++bit)
      for (const bool value : {false, true}) hidden_.push_back({id, bit, value});
  }
}

std::vector<Vector> ShownBits::new_ones(std::span<const Vector> vectors) {
  std::vector<std::vector<std::int64_t>> operands;
  for (const Vector& vector : vectors) {
    std::vector<std::int64_t>& own = operands.emplace_back();
    for (const std::size_t place : places_) own.push_back(vector.operands[place]);
  }
  lanes_.load(operands);
  std::uint64_t taken = 0;
  std::erase_if(hidden_, [&](const Bit& hidden) {
    const Word bit = Word{1} << hidden.bit;
    Lanes wrong = lanes_.right(hidden.node);
    for (Word& each : wrong) each = hidden.value ? each & ~bit : each | bit;
    const std::uint64_t shown = lanes_.shown_by(hidden.node, wrong);
    if ((shown & taken) == 0) taken |= shown & (~shown + 1);
    return shown != 0;
  });
  std::vector<Vector> chosen;
  for (std::size_t i = 0; i < vectors.size(); ++i)
    if ((taken >> i & 1U) != 0) chosen.push_back(vectors[i]);
  return chosen;
}

namespace {

// Of 16 vectors, four have operands at corners, four have them at corners beside a hit, and one lies beside
// any hit. The other seven are at the border between hit and miss.
constexpr std::size_t of_corners = 4;
constexpr std::size_t of_any = 1;

constexpr std::size_t most_rare_draws = 48'000;
constexpr std::size_t most_starts = 32;  ///< rare vectors are sought beside so many of the last found

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
  Vector vector = with_results(std::move(operands), unit_.evaluate);
  if (unit_.evaluate.yes(vector.results.data())) last = vector.operands;
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
        with_results(random_() % 4 == 0 ? draw_.beside(start, random_) : draw_.corners_beside(start, random_),
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
  // The logic of a float operator is too long to be run for each of its bits. Floats near the ends of their
  // range reach most of them.
  if (unit_.graph.submodules().empty()) {
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
  } else {
    std::vector<const Vector*> hits;
    for (const VectorGroup& group : groups)
      for (const Vector& each : group.vectors)
        if (unit_.evaluate.yes(each.results.data())) hits.push_back(&each);
    while (rare.vectors.size() < count && !hits.empty()) {
      Vector scaled =
          with_results(draw_.scaled(hits[random_() % hits.size()]->operands, random_), unit_.evaluate);
      std::vector<Vector> near = border(scaled.operands);
      near.push_back(std::move(scaled));
      for (Vector& each : near)
        if (rare.vectors.size() < count) rare.vectors.push_back(std::move(each));
    }
  }
  for (Vector& each : borders(count - rare.vectors.size())) rare.vectors.push_back(std::move(each));
  return rare;
}

}  // namespace hitpipe::rtl
