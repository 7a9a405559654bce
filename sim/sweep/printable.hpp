// Names as cells and comments of a file of lines.
#pragma once

#include <string>

namespace hitpipe::sim {

/// With a blank for each control character: a scene's name comes from a file's and may hold any.
[[nodiscard]] std::string printable(std::string text);

}  // namespace hitpipe::sim
