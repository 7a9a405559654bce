// The folder that a unit is written to. Units of other names live in it beside this one, and so do files of
// the user's own.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"

namespace hitpipe::rtl {

struct UnitFiles {
  std::vector<host::File> files;  ///< the manifest lists all of them
  bool drawn = true;  ///< false: Graphviz is not installed, and the schematics are .dot files only
};

/// One line for the user, when a unit is not drawn.
inline constexpr std::string_view not_drawn =
    "the schematics are .dot files only, because Graphviz's dot was not found; install the package graphviz";

/// The files of a unit and the drawings of its schematics. Throws as draw() does.
[[nodiscard]] UnitFiles files_and_drawings(const EmittedDesign& emitted);

/// Writes these files to the folder. Removes what the previous manifest of a unit of this name lists and this
/// run does not write, unless another unit's manifest lists it too. It removes regular files only, and only
/// inside the folder; a folder that this empties goes too. Throws as files_and_drawings() and
/// host::write_files() do.
UnitFiles write_unit(const std::filesystem::path& folder, const EmittedDesign& emitted);

}  // namespace hitpipe::rtl
