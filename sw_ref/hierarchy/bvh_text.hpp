// Writes a hierarchy as a file that load_bvh() reads (docs/bvh.md).
#pragma once

#include <string>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/scene/mesh.hpp"

namespace hitpipe::ref {

/// The text of such a file, in the cube. Reading it gives the same hierarchy, bit for bit.
[[nodiscard]] std::string bvh_text(const Bvh& bvh, const Mesh& mesh);

}  // namespace hitpipe::ref
