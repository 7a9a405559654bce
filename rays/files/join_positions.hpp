// Equal positions of a mesh become one.
#pragma once

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// Keeps each position that a triangle uses, a dropped one too, once, in the order of first appearance.
void join_positions(SourceMesh& mesh);

}  // namespace hitpipe::ref
