// A unit as it was written to a folder.
#pragma once

#include <filesystem>

#include "rtl_gen/emit/unit.hpp"

namespace hitpipe::rtl {

/// From a folder that `hitpipe fit` or `hitpipe rtl` wrote: the Verilog may be edited. `place` is the unit's
/// manifest, or a folder with one manifest of the design; the Verilog is beside it. Throws std::runtime_error
/// or std::invalid_argument, one line, when a file is missing or damaged, or belongs to another design or
/// library, and when the folder has units of the design under several names.
[[nodiscard]] Unit read_unit(const std::filesystem::path& place, const Design& design,
                             const Library& library);

}  // namespace hitpipe::rtl
