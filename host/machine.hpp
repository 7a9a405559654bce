// The machine on which something was measured, for what stands beside times.
#pragma once

#include <string>

namespace hitpipe::host {

/// "AMD EPYC 7713", as the system names it; "unknown" if it does not.
[[nodiscard]] std::string processor();

/// Which compiler made this program: "g++ 12.2.0".
[[nodiscard]] std::string compiler();

/// The day in UTC: "2026-11-28".
[[nodiscard]] std::string today();

}  // namespace hitpipe::host
