// Which program this is.
#pragma once

#include <string_view>

namespace hitpipe::cli {

/// "hitpipe 1.2.3"
[[nodiscard]] std::string_view program_version();

/// "hitpipe 1.2.3 (3f9a2c1d)", with the first 32 bits of a hash of the sources that results depend on. It
/// does not depend on machine, folder or compiler.
[[nodiscard]] std::string_view program_and_sources();

}  // namespace hitpipe::cli
