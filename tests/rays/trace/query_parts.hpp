// What tests of ray queries in both worlds share.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "rays/trace/fast_tracer.hpp"
#include "rays/trace/ray_queries.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/rays/trace/tracer_scenes.hpp"

namespace hitpipe::ref::query_parts {

using Crossings = std::vector<RayCrossing>;

inline std::vector<VectorWidth> widths() {
  std::vector<VectorWidth> all{VectorWidth::four};
  if (has_vectors(VectorWidth::eight)) all.push_back(VectorWidth::eight);
  return all;
}

/// The largest double that is not above it.
inline bool is_floor(double x, const oracle::Rational& exact) {
  return oracle::exact(x) <= exact &&
         oracle::exact(std::nextafter(x, std::numeric_limits<double>::max())) > exact;
}

inline std::vector<Mesh> meshes(Random& random) {
  return {soup(random, 200), grid_soup(random, 80), hills(9), soup(random, 3)};
}

}  // namespace hitpipe::ref::query_parts
