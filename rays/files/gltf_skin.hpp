// Skins of a glTF file, without animation: each joint is where its node is.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "rays/files/gltf_accessor.hpp"
#include "rays/files/gltf_document.hpp"
#include "rays/files/gltf_nodes.hpp"

namespace hitpipe::ref {

class GltfSkins {
 public:
  GltfSkins(const GltfDocument& document, const GltfNodes& nodes);

  [[nodiscard]] std::size_t joints(const Place& number) const {
    return document_.item("skins", number).at("joints").size();
  }
  /// For each joint of the skin: how it moves a position that it alone holds.
  [[nodiscard]] std::vector<GltfTransform> matrices(GltfAccessors& accessors, const Place& number) const;

 private:
  const GltfDocument& document_;
  std::map<std::size_t, GltfTransform> joints_;  ///< by node
};

}  // namespace hitpipe::ref
