// Reads cases from text, to run them again.
#pragma once

#include <string_view>

#include "sw_ref/judge/adversary/case.hpp"

namespace hitpipe::ref::adversary {

/// Reads what to_text(Case) writes. Numbers may be decimal or hexadecimal, and a length may be inf. Throws
/// std::runtime_error, one line that names the word that it cannot read, or says why the case is not
/// acceptable.
[[nodiscard]] Case parse_case(std::string_view text);

}  // namespace hitpipe::ref::adversary
