// The Python programs that draw and write pages. They lie beside an installed program, in share/hitpipe/report,
// or in the sources of the build folder that the program is in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/files.hpp"

namespace hitpipe::cli {

/// The words that start this program of the folder. $PYTHON chooses the interpreter. Throws
/// std::runtime_error, one line that begins with the command's name, when no Python has matplotlib and jinja2.
[[nodiscard]] std::vector<std::string> python_program(const std::string& command, const std::string& file);

/// Pictures of the rows of `check --stiff`, as SVG, PDF and PNG, this wide or as a page needs them. Throws
/// std::runtime_error, one line, when `drawer`, of python_program(), cannot draw.
[[nodiscard]] std::vector<host::File> stiffness_pictures(const std::vector<std::string>& drawer,
                                                         const std::string& csv,
                                                         const std::optional<double>& width_mm);

}  // namespace hitpipe::cli
