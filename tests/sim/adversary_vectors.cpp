#include "tests/sim/adversary_vectors.hpp"

#include "rtl_gen/emit/testbench.hpp"
#include "sim/feed.hpp"
#include "tests/sim/corner_values.hpp"

namespace hitpipe::sim {

std::vector<std::vector<std::int64_t>> adversary_vectors(const Unit& unit,
                                                         const ref::adversary::Category& category, int count,
                                                         std::uint64_t seed) {
  ref::adversary::Random random(seed);
  std::vector<ref::Ray> rays;
  ref::Bvh bvh;  // only its boxes are read
  for (int i = 0; i < count; ++i) {
    const ref::adversary::Case c = category.make(random);
    rays.push_back(c.ray);
    bvh.nodes.push_back({c.box, 0, 0});
  }
  const auto scene = make_feed(unit.design(), unit.format, bvh);
  const auto feed = scene->unit(1);
  std::vector<std::vector<std::int64_t>> vectors(rays.size(),
                                                 std::vector<std::int64_t>(verilated(unit).operand_count()));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    feed->start(0, rays[i]);
    feed->operands(0, static_cast<std::uint32_t>(i), rays[i].length, vectors[i].data());
  }
  return vectors;
}

std::vector<std::vector<std::int64_t>> raw_corner_vectors(const std::vector<rtl::Port>& ports, int count,
                                                          std::uint64_t seed) {
  ref::adversary::Random random(seed);
  auto vectors = rtl::operand_vectors(ports, count, seed);
  for (std::size_t p = 0; p < ports.size(); ++p) {
    if (ports[p].width == 1) continue;
    const std::vector<CornerValue> corners = ports[p].is_signed                    ? integer_corners(ports[p])
                                             : ports[p].kind == hls::Kind::natural ? natural_corners(ports[p])
                                                                                   : float_corners();
    for (auto& operands : vectors) {
      if (random.below(4) != 0) operands[p] = corners[random.below(corners.size())].value;
    }
  }
  return vectors;
}

}  // namespace hitpipe::sim
