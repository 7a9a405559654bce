#include "tests/sim/adversary_vectors.hpp"

#include "rtl_gen/emit/vectors.hpp"
#include "sim/software/box_software.hpp"

namespace hitpipe::sim {
namespace {

// Values at the corners of a port, by name: bit patterns where arithmetic breaks.
struct CornerValue {
  const char* name;
  std::int64_t value;
};

/// 2^(w-1): one more than the largest value of a signed port.
std::int64_t top(const rtl::Port& port) {
  return std::int64_t{1} << (port.width - 1);
}

/// For a signed port of w bits.
std::vector<CornerValue> integer_corners(const rtl::Port& port) {
  return {{"zero", 0},
          {"one", 1},
          {"-1: every bit set", -1},
          {"greatest", top(port) - 1},
          {"least", -top(port)},
          {"the grid's end G", top(port) / 2 - 1},
          {"-G", -(top(port) / 2 - 1)},
          {"one past the grid, of an outward rounded box", top(port) / 2},
          {"one past it downwards", -top(port) / 2},
          {"bits 0101", std::int64_t{0x5555555555555555} & (top(port) - 1)}};
}

/// For an unsigned integer port of w bits.
std::vector<CornerValue> natural_corners(const rtl::Port& port) {
  return {{"zero", 0},
          {"one", 1},
          {"every bit set", 2 * top(port) - 1},
          {"all but the lowest", 2 * top(port) - 2},
          {"the top bit alone", top(port)},
          {"all but the top bit", top(port) - 1}};
}

/// Patterns of a float format.
std::vector<CornerValue> float_corners(const hls::FpBits& bits) {
  const std::int64_t sign = std::int64_t{1} << (bits.exponent + bits.fraction);
  const std::int64_t infinity = sign - (std::int64_t{1} << bits.fraction);
  const std::int64_t normal = std::int64_t{1} << bits.fraction;
  const std::int64_t one = ((std::int64_t{1} << (bits.exponent - 1)) - 1) << bits.fraction;
  return {{"+0", 0},
          {"-0", sign},
          {"smallest subnormal", 1},
          {"smallest subnormal, negative", sign + 1},
          {"largest subnormal", normal - 1},
          {"smallest normal", normal},
          {"1", one},
          {"-1", sign + one},
          {"next below 1", one - 1},
          {"next above 1", one + 1},
          {"largest", infinity - 1},
          {"largest, negative", sign + infinity - 1},
          {"infinity", infinity},
          {"-infinity", sign + infinity},
          {"canonical NaN", infinity + normal / 2},
          {"negative NaN with other fraction bits",
           sign + infinity + (std::int64_t{0x412345} >> (23 - bits.fraction))},
          {"signalling NaN", infinity + 1}};
}

/// What the port takes of such a pattern: all of it, or no sign.
std::int64_t as_port(const rtl::Port& port, std::int64_t pattern) {
  return pattern & (2 * top(port) - 1);
}

}  // namespace

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
