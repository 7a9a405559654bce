// What `hitpipe core fit` says of a core.
#pragma once

#include "cli/text/table.hpp"
#include "sim/fit/core_fit.hpp"

namespace hitpipe::cli {

/// Its options, what it takes, and its rate in the slowest scene.
[[nodiscard]] Row core_row(const rtl::CoreOptions& core, const area::CorePartPrice& price,
                           const sim::CoreRate& rate, const rtl::Library& library);

}  // namespace hitpipe::cli
