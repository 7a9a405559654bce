// The vectors that a testbench replays, in groups by where they come from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::rtl {

struct VectorGroup {
  std::string from;  ///< "corners", or the name of a category of rays and boxes
  std::vector<Vector> vectors;
};

struct VectorSet {
  std::uint64_t seed = 0;
  std::vector<VectorGroup> groups;

  [[nodiscard]] std::size_t size() const;
  /// All, group by group.
  [[nodiscard]] std::vector<Vector> all() const;
};

/// How many of them hit a box.
[[nodiscard]] std::size_t hits(const std::vector<Vector>& vectors, const std::vector<hls::Result>& results);

/// Comment lines at the head of the vector file: the unit, the seed, how many vectors hit, and the lines of
/// each group.
[[nodiscard]] std::string vector_summary(const std::string& unit, const VectorSet& set,
                                         const std::vector<hls::Result>& results);

}  // namespace hitpipe::rtl
