// Names as cells and comments of a text file with one row in each line.
#pragma once

#include <string>

namespace hitpipe::sim {

/// Replaces each control character with a blank. A scene's name can come from a file name, which may hold
/// any.
[[nodiscard]] std::string printable(std::string text);

}  // namespace hitpipe::sim
