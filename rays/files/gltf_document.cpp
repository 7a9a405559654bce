#include "rays/files/gltf_document.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/glb.hpp"
#include "rays/files/gltf_uri.hpp"

namespace hitpipe::ref {
namespace {

/// They change no triangle and no transform of a file that is not animated. A name that ends in _ stands for
/// all names that begin so.
constexpr std::array<std::string_view, 24> gltf_extensions_read{"KHR_mesh_quantization",
                                                                "KHR_materials_",
                                                                "ADOBE_materials_",
                                                                "KHR_texture_",
                                                                "EXT_texture_",
                                                                "MSFT_texture_dds",
                                                                "MSFT_packing_normalRoughnessMetallic",
                                                                "MSFT_packing_occlusionRoughnessMetallic",
                                                                "KHR_technique_webgl",
                                                                "KHR_techniques_webgl",
                                                                "KHR_lights_punctual",
                                                                "EXT_lights_ies",
                                                                "EXT_lights_image_based",
                                                                "KHR_animation_pointer",
                                                                "KHR_audio_emitter",
                                                                "KHR_xmp",
                                                                "KHR_xmp_json_ld",
                                                                "KHR_node_hoverability",
                                                                "KHR_node_selectability",
                                                                "EXT_instance_features",
                                                                "EXT_mesh_features",
                                                                "EXT_structural_metadata",
                                                                "AGI_stk_metadata",
                                                                "GODOT_single_root"};

bool is_extension_read(std::string_view extension) {
  return std::any_of(gltf_extensions_read.begin(), gltf_extensions_read.end(), [&](std::string_view known) {
    return known.ends_with('_') ? extension.starts_with(known) : extension == known;
  });
}

}  // namespace

GltfDocument::GltfDocument(std::string_view bytes, const std::filesystem::path& file)
    : folder_(file.parent_path()), bytes_(bytes.size()) {
  std::string_view json = bytes;
  if (is_glb(bytes) || file.extension() == ".glb") {
    const GlbChunks chunks = read_glb(bytes);
    json = chunks.json;
    chunk_ = chunks.binary;
  }
  root_ = parse_json_text(json);
  if (!root_.is_object()) reject("the JSON must be an object");
  check_version();
  for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
    if (!top().has(list)) continue;
    for (const Place& name : top().at(list).elements()) extensions_.push_back(name.word());
  }
  check_extensions();
}

void GltfDocument::check_version() const {
  const Place asset = top().at("asset");
  // Some files of glTF 1.0 have a number there.
  const bool is_number = asset.has("version") && root_["asset"]["version"].is_number();
  const std::string version =
      is_number ? fmt::format("{:.1f}", asset.at("version").number()) : asset.at("version").word();
  if (version.starts_with("1."))
    reject(fmt::format("glTF {} is not read; allowed is 2.0", host::shortened(version)));
  if (is_number || !version.starts_with("2."))
    asset.at("version").fail(fmt::format("\"{}\" is not read; allowed is 2.0", host::shortened(version)));
  if (asset.has("minVersion") && asset.at("minVersion").word() != "2.0")
    asset.at("minVersion")
        .fail(fmt::format("\"{}\" is not read; allowed is 2.0",
                          host::shortened(asset.at("minVersion").word())));
}

void GltfDocument::check_extensions() const {
  if (!top().has("extensionsRequired")) return;
  for (const Place& name : top().at("extensionsRequired").elements()) {
    if (!is_extension_read(name.word()))
      name.fail(fmt::format("the extension \"{}\" is not read; give a file that does not require it",
                            host::shortened(name.word())));
  }
}

std::size_t GltfDocument::size(const char* list) const {
  return top().has(list) ? top().at(list).size() : 0;
}

Place GltfDocument::item(const char* list, std::size_t i) const {
  Place entry = top().at(list).element(i);
  if (!entry.is_object()) entry.fail("must be an object");
  return entry;
}

std::uint64_t GltfDocument::index(const char* list, const Place& number) const {
  const std::size_t entries = size(list);
  if (entries == 0) number.fail(fmt::format("must name one of {}, of which the file has none", list));
  return number.count(entries - 1);
}

bool GltfDocument::uses(std::string_view extension) const {
  return std::find(extensions_.begin(), extensions_.end(), extension) != extensions_.end();
}

std::string_view GltfDocument::buffer(std::uint64_t number) {
  if (const auto known = buffers_.find(number); known != buffers_.end()) return known->second;
  const Place place = item("buffers", number);
  constexpr std::uint64_t most = std::uint64_t{1} << 53U;
  const std::uint64_t length = place.at("byteLength").count(most);
  std::string_view bytes;
  if (place.has("uri")) {
    bytes = open(place.at("uri"));
  } else {
    if (number != 0 || !chunk_)
      place.fail("needs the key \"uri\"; only the first buffer of a GLB may be its BIN chunk");
    bytes = *chunk_;
  }
  if (bytes.size() < length)
    place.at("byteLength").fail(fmt::format("announces {} bytes; the buffer has {}", length, bytes.size()));
  return buffers_[number] = bytes.substr(0, length);
}

std::string_view GltfDocument::open(const Place& uri) {
  const std::string text = uri.word();
  if (is_data_uri(text)) {
    decoded_.push_back(std::make_unique<std::string>(decoded_data_uri(uri, text)));
    return *decoded_.back();
  }
  const std::string name = decoded_file_uri(uri, text);
  const auto [opened, is_new] = files_.try_emplace(name);
  if (is_new) {
    opened->second = buffer_file_bytes(folder_ / name, name);
    bytes_ += opened->second.size();
  }
  return opened->second;
}

}  // namespace hitpipe::ref
