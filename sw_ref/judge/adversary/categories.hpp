// Rays and boxes that are likely to break ray-box tests, by named category (sections 6.2 and 6.3). They serve
// in tests and for judging a design. The referee accepts every case (sw_ref/judge/box_referee.hpp).
#pragma once

#include <span>
#include <string_view>

#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::ref::adversary {

struct Category {
  std::string_view name;  ///< one word, for tables and options
  std::string_view what;  ///< what is special about it
  Case (*make)(Random& random);
};

[[nodiscard]] std::span<const Category> categories();

}  // namespace hitpipe::ref::adversary
