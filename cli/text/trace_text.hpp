// What a core did with a picture's rays, as figures.
#pragma once

#include "cli/text/table.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/core/core_trace.hpp"

namespace hitpipe::cli {

/// With a cache also the share of its hits.
[[nodiscard]] Row trace_row(const rtl::Core& core, const sim::CoreTrace& trace, bool cache);

}  // namespace hitpipe::cli
