// What options a core may have (core.hpp), and what follows from them.
#pragma once

#include "hls/machines/cache_fields.hpp"
#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// Throws std::runtime_error, one line, for options outside their limits or that do not go together.
void check_core_options(const CoreOptions& options);

/// Of a core that has a cache.
[[nodiscard]] hls::CacheBits cache_bits(const CoreOptions& options);

}  // namespace hitpipe::rtl
