// Cases as text, to be run again.
#pragma once

#include <string_view>

#include "sw_ref/adversary/case.hpp"

namespace hitpipe::ref::adversary {

/// What to_text(Case) writes; numbers may be decimal or hexadecimal, a length may be inf. Throws
/// std::runtime_error, one line, that names the word it cannot read, or says why the case is not acceptable.
[[nodiscard]] Case parse_case(std::string_view text);

}  // namespace hitpipe::ref::adversary
