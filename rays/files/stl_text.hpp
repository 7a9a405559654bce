// The text form of STL.
#pragma once

#include <string_view>

#include "rays/files/file_mesh.hpp"

namespace hitpipe::ref {

/// True if the bytes begin as the text form does, as far as they go: "solid", a name, "facet" or an end.
[[nodiscard]] bool begins_as_stl_text(std::string_view bytes);

[[nodiscard]] FileMesh read_stl_text(std::string_view text);

/// Adds a corner with a position of its own. `unit` and `place` say where it stands, for a message.
void add_stl_corner(FileMesh& mesh, const glm::dvec3& corner, std::string_view unit, std::size_t place);

}  // namespace hitpipe::ref
