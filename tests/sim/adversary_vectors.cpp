#include "tests/sim/adversary_vectors.hpp"

#include "rtl_gen/emit/vectors.hpp"
#include "sim/check/box_test.hpp"
#include "tests/sim/corner_values.hpp"

namespace hitpipe::sim {

std::vector<std::vector<std::int64_t>> adversary_vectors(const TestedUnit& unit,
                                                         const ref::adversary::Category& category, int count,
                                                         std::uint64_t seed) {
  ref::adversary::Random random(seed);
  const auto test = make_box_test(unit.design(), unit.format);
  std::vector<std::vector<std::int64_t>> vectors;
  for (int i = 0; i < count; ++i) {
    const ref::adversary::Case c = category.make(random);
    test->start(c.ray);
    (void)test->hit(c.box);
    vectors.emplace_back(test->operands().begin(), test->operands().end());
  }
  return vectors;
}

std::vector<std::vector<std::int64_t>> raw_corner_vectors(const TestedUnit& unit, int count,
                                                          std::uint64_t seed) {
  const std::vector<rtl::Port> ports = unit.ports();
  ref::adversary::Random random(seed);
  auto vectors = rtl::operand_vectors(ports, count, seed);
  for (std::size_t p = 0; p < ports.size(); ++p) {
    if (ports[p].width == 1) continue;
    const auto float_bits = unit.float_bits();
    const std::vector<CornerValue> corners = float_bits           ? float_corners(*float_bits)
                                             : ports[p].is_signed ? integer_corners(ports[p])
                                                                  : natural_corners(ports[p]);
    for (auto& operands : vectors) {
      if (random.below(4) == 0) continue;
      const std::int64_t value = corners[random.below(corners.size())].value;
      operands[p] = float_bits ? as_port(ports[p], value) : value;
    }
  }
  return vectors;
}

}  // namespace hitpipe::sim
