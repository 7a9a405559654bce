// The additional fields in the manifest of a fitted unit: its demands, which software must check, and the
// ports that are gone or narrower.
#pragma once

#include <string>

#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

/// Adds to the manifest `demands` (port, within and low_zeros if any, or lesser and greater),
/// `dropped_ports`, `narrowed_ports` (name, from, to bits) and `left_out` (a line for each cut). Without
/// demands the manifest does not change.
[[nodiscard]] std::string with_demand_fields(const std::string& manifest, const Demands& demands,
                                             const PruneReport& report);

/// The demands of a manifest; none when it has no field `demands`. Throws std::runtime_error, one line, when
/// the field is not as with_demand_fields() writes it.
[[nodiscard]] Demands demands_of_manifest(const std::string& manifest);

}  // namespace hitpipe::rtl
