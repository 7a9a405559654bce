// Reader of STL: text and binary.
#pragma once

#include <string_view>

#include "rays/files/file_mesh.hpp"

namespace hitpipe::ref {

/// The facets of an STL file; each has three positions of its own.
///
/// A file is binary if it has exactly the bytes that its count of facets needs. Otherwise it is text if it
/// begins with "solid" and goes on as text behind the name. Any other file is binary. A binary file may
/// have up to 49 bytes behind the last facet, which can hold no facet; they are skipped. Its header and
/// attributes are skipped too.
///
/// Words of a text have any case, and white space may be anywhere. It may have several solids; each is a
/// group. A name goes to the end of its line, or to the facet or solid that follows it there. Facet normals must be
/// numbers, but are not used. Throws std::runtime_error, one line without the file's name, for a file that is cut
/// short, other words, and coordinates that are not finite.
[[nodiscard]] FileMesh read_stl(std::string_view bytes);

}  // namespace hitpipe::ref
