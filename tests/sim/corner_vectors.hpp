// Operands at the corners of a unit, by name. Integer units: bit patterns where arithmetic breaks, and the
// ends of the ranges of ray set-up and quantisation (section 6.2.1). Float units: every pair of corner
// values. Each comes with rinf (and every other flag) 0 and 1; if there is a length, with irlen 0 and the
// largest. Units with a major axis: ends of the ranges of all ports, with each major axis, forward and
// backward.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/sim/corner_values.hpp"
#include "tests/sim/units.hpp"

namespace hitpipe::sim {

struct CornerVector {
  std::string name;
  std::vector<std::int64_t> operands;
};

/// Every pair of float corner values on even and odd ports.
inline std::vector<CornerVector> float_corner_vectors(const std::vector<rtl::Port>& ports,
                                                      const hls::FpBits& bits) {
  std::vector<CornerVector> vectors;
  for (const CornerValue& even : float_corners(bits)) {
    for (const CornerValue& odd : float_corners(bits)) {
      for (const bool infinite : {false, true}) {
        CornerVector corner{even.name + std::string(" and ") + odd.name, {}};
        corner.name += infinite ? ", rinf 1" : ", rinf 0";
        for (int i = 0; const rtl::Port& port : ports) {
          const std::int64_t rinf = infinite ? 1 : 0;
          corner.operands.push_back(port.width == 1 ? rinf
                                                    : as_port(port, (i++ % 2 == 0 ? even : odd).value));
        }
        vectors.push_back(std::move(corner));
      }
    }
  }
  return vectors;
}

inline bool has(const std::vector<rtl::Port>& ports, hls::Role role) {
  return std::any_of(ports.begin(), ports.end(), [&](const auto& port) { return port.role == role; });
}

inline std::vector<CornerVector> integer_corner_vectors(const std::vector<rtl::Port>& ports) {
  using hls::Role;
  struct Pattern {
    const char* name;
    std::int64_t (*value)(const rtl::Port& port, int index);  // of a signed port of w bits
  };
  static constexpr auto is_inverse = [](const rtl::Port& port) {
    return port.role == Role::inverse_low || port.role == Role::inverse_high;
  };
  static constexpr Pattern patterns[] = {
      {"all zero", [](const rtl::Port&, int) { return std::int64_t{0}; }},
      {"all one", [](const rtl::Port&, int) { return std::int64_t{1}; }},
      {"all -1: every bit set", [](const rtl::Port&, int) { return std::int64_t{-1}; }},
      {"all greatest: no difference is left", [](const rtl::Port& p, int) { return top(p) - 1; }},
      {"all least: differences are 0, products the greatest",
       [](const rtl::Port& p, int) { return -top(p); }},
      {"greatest and least in turn: differences wrap",
       [](const rtl::Port& p, int i) { return i % 2 == 0 ? top(p) - 1 : -top(p); }},
      {"least and greatest in turn",
       [](const rtl::Port& p, int i) { return i % 2 == 0 ? -top(p) : top(p) - 1; }},
      {"bits 0101", [](const rtl::Port& p, int) { return std::int64_t{0x5555555555555555} & (top(p) - 1); }},
      {"bits 1010",
       [](const rtl::Port& p, int) { return ~(std::int64_t{0x5555555555555555} & (top(p) - 1)); }},
      {"the cube's corner and its opposite: greatest difference that fits",
       [](const rtl::Port& p, int) {
         if (p.role == Role::origin) return top(p) / 2 - 1;  // G
         if (p.role == Role::plane_low) return -top(p) / 2;  // -(G + 1)
         if (p.role == Role::plane_high) return top(p) / 2;
         return top(p) - 1;  // M, the IRDVC of the smallest component
       }},
      {"the same, backward",
       [](const rtl::Port& p, int) {
         if (p.role == Role::origin) return -(top(p) / 2 - 1);
         if (p.role == Role::plane_low) return -top(p) / 2;
         if (p.role == Role::plane_high) return top(p) / 2;
         return -(top(p) - 1);
       }},
      {"an axis-parallel ray: IRDVC 0 or 1 on two axes",
       [](const rtl::Port& p, int) {
         if (is_inverse(p) && p.axis == hls::Axis::x) return top(p) - 1;
         if (p.role == Role::inverse_high) return std::int64_t{1};
         if (p.role == Role::plane_low) return -top(p) / 4;
         if (p.role == Role::plane_high) return top(p) / 4;
         return std::int64_t{0};
       }},
      {"a box of one point at the ray's origin",
       [](const rtl::Port& p, int) {
         return p.role == Role::inverse_low    ? -top(p) / 2
                : p.role == Role::inverse_high ? -top(p) / 2 + 1
                                               : top(p) / 4;
       }},
  };
  const bool has_length = has(ports, Role::length);
  std::vector<CornerVector> vectors;
  for (const Pattern& pattern : patterns) {
    for (const bool infinite : {false, true}) {
      if (infinite && !has(ports, Role::endless)) continue;
      for (const bool longest : {false, true}) {
        if (longest && !has_length) continue;
        CornerVector corner{pattern.name, {}};
        corner.name += infinite ? ", rinf 1" : ", rinf 0";
        if (has_length) corner.name += longest ? ", irlen greatest" : ", irlen 0";
        for (int i = 0; const rtl::Port& port : ports) {
          std::int64_t value = 0;
          if (port.role == Role::endless) {
            value = infinite ? 1 : 0;
          } else if (port.role == Role::length) {
            value = longest ? top(port) - 1 : 0;
          } else {
            value = pattern.value(port, i);
          }
          corner.operands.push_back(value);
          ++i;
        }
        vectors.push_back(std::move(corner));
      }
    }
  }
  return vectors;
}

inline std::vector<CornerVector> major_corner_vectors(const std::vector<rtl::Port>& ports) {
  struct Pattern {
    const char* name;
    std::int64_t (*value)(const rtl::Port& port, int index);
  };
  static constexpr Pattern patterns[] = {
      {"all zero", [](const rtl::Port&, int) { return std::int64_t{0}; }},
      {"every bit set", [](const rtl::Port&, int) { return std::int64_t{-1}; }},
      {"all least", [](const rtl::Port& p, int) { return p.range->low; }},
      {"all greatest", [](const rtl::Port& p, int) { return p.range->high; }},
      {"greatest and least in turn",
       [](const rtl::Port& p, int i) { return i % 2 == 0 ? p.range->high : p.range->low; }},
      {"least and greatest in turn",
       [](const rtl::Port& p, int i) { return i % 2 == 0 ? p.range->low : p.range->high; }},
      {"an origin at one end of the cube, a box at the other, the largest quotient",
       [](const rtl::Port& p, int) {
         return p.role == hls::Role::origin                                         ? p.range->low + 1
                : p.role == hls::Role::plane_low || p.role == hls::Role::plane_high ? p.range->high - 1
                                                                                    : p.range->high;
       }},
      {"the same, from above",
       [](const rtl::Port& p, int) {
         return p.role == hls::Role::plane_low || p.role == hls::Role::plane_high ? p.range->low
                                                                                  : p.range->high;
       }},
  };
  std::vector<CornerVector> vectors;
  for (const Pattern& pattern : patterns) {
    for (const hls::Axis major : {hls::Axis::x, hls::Axis::y, hls::Axis::z}) {
      for (const bool backward : {false, true}) {
        CornerVector corner{pattern.name + std::string(backward ? ", backward " : ", forward ") +
                                "?xyz" [static_cast<int>(major)],
                            {}};
        for (int i = 0; const rtl::Port& port : ports) {
          const std::int64_t flag = port.role == hls::Role::major ? port.axis == major : backward;
          corner.operands.push_back(port.width == 1 ? flag : pattern.value(port, i));
          ++i;
        }
        vectors.push_back(std::move(corner));
      }
    }
  }
  return vectors;
}

inline std::vector<CornerVector> corner_vectors(const TestedUnit& unit) {
  const std::vector<rtl::Port> ports = unit.ports();
  if (has(ports, hls::Role::major)) return major_corner_vectors(ports);
  if (const auto bits = unit.float_bits()) return float_corner_vectors(ports, *bits);
  return integer_corner_vectors(ports);
}

}  // namespace hitpipe::sim
