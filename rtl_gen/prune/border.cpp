#include "rtl_gen/prune/border.hpp"

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
    Vector there = judged(std::move(operands), evaluate_);
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
    Vector between = judged(std::move(operands), evaluate_);
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
    Vector changed = judged(std::move(operands), evaluate_);
    if (changed.results[way.answer] == as.results[way.answer]) return changed;
  }
  return std::nullopt;
}

std::vector<Vector> Border::near(const std::vector<std::int64_t>& operands, std::mt19937_64& random) const {
  std::optional<Way> found;
  Vector here = judged(operands, evaluate_);
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

}  // namespace hitpipe::rtl
