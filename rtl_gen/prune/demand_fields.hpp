// What a fitted unit's manifest says beside a plain one's: its demands, for software to check before use, and
// what became of the ports.
#pragma once

#include <string>

#include "rtl_gen/prune/report.hpp"

namespace hitpipe::rtl {

/// The manifest with `demands` (port, within and any low_zeros, or lesser and greater), `dropped_ports`,
/// `narrowed_ports` (name, from, to bits) and `left_out` (a line for each cut) behind its other keys. Without
/// demands it is the manifest as it was.
[[nodiscard]] std::string with_demand_fields(const std::string& manifest, const Demands& demands,
                                             const PruneReport& report);

/// The demands of such a manifest; none when it has no field `demands`. Throws std::runtime_error, one line,
/// when the field is not as with_demand_fields() writes it.
[[nodiscard]] Demands demands_of_manifest(const std::string& manifest);

}  // namespace hitpipe::rtl
