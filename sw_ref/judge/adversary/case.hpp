// One ray and one box, made to break a ray-box test; its text, and how to find the simplest that still does.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref::adversary {

struct Case {
  Ray ray;
  Aabb box;
};

/// All coordinates as hexadecimal floats, which are exact and readable by C++.
[[nodiscard]] std::string to_text(const Ray& ray);
[[nodiscard]] std::string to_text(const Case& c);

/// Replaces one number at a time by a simpler one: an infinite length, 0, +-1, fewer mantissa bits, or an
/// exponent closer to the exponent of 1. The case must stay acceptable, and `fails` must still be true. Ends
/// when no replacement is left. `fails(c)` must be true for the given case.
[[nodiscard]] Case shrink(Case c, const std::function<bool(const Case&)>& fails);

/// Reads what to_text(Case) writes. Numbers may be decimal or hexadecimal, and a length may be inf. Throws
/// std::runtime_error, one line that names the word that it cannot read, or says why the case is not
/// acceptable.
[[nodiscard]] Case parse_case(std::string_view text);

}  // namespace hitpipe::ref::adversary
