#include "rays/files/gltf_document.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include <fmt/format.h>

#include "host/outputs.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/glb.hpp"

namespace hitpipe::ref {
namespace {

std::optional<std::uint32_t> base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return std::nullopt;
}

std::optional<int> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return std::nullopt;
}

bool is_data_uri(std::string_view uri) {
  return uri.starts_with("data:");
}

/// The bytes of a data URI in base64. `place` is named if it is another.
std::string decoded_data_uri(const Place& place, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
    place.fail("is a data URI without \";base64,\"; allowed are data URIs with it");
  std::string_view digits = uri.substr(comma + 1);
  for (int padding = 0; padding < 2 && digits.ends_with('='); ++padding) digits.remove_suffix(1);
  if (digits.size() % 4 == 1)
    place.fail(fmt::format("has {} base64 digits; the last one has no bits of a byte", digits.size()));
  std::string bytes;
  bytes.reserve(digits.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const auto digit = base64_digit(digits[i]);
    if (!digit)
      place.fail(fmt::format(
          "character {} of the base64 data is \"{}\"; allowed are letters, digits, + and /", i, digits[i]));
    bits = bits << 6U | *digit;
    if (i % 4 != 0) bytes.push_back(static_cast<char>(bits >> (6U - 2U * (i % 4)) & 0xFFU));
  }
  return bytes;
}

/// The name of the file: %20 is a blank. Refuses all but relative names.
std::string decoded_file_uri(const Place& place, std::string_view uri) {
  // A scheme such as "http:" is letters before the first colon, of which a path has none before.
  const bool has_scheme = uri.find(':') < std::min(uri.find('/'), uri.size());
  if (uri.empty() || uri.starts_with('/') || has_scheme)
    place.fail(fmt::format("\"{}\" is not read; allowed are data URIs and names relative to the file",
                           host::shortened(uri)));
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      name.push_back(uri[i]);
      continue;
    }
    const auto high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : std::nullopt;
    const auto low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : std::nullopt;
    if (!high || !low || *high + *low == 0)
      place.fail(
          fmt::format("\"{}\" has a % without two hexadecimal digits, 01 to FF", host::shortened(uri)));
    name.push_back(static_cast<char>(16 * *high + *low));
    i += 2;
  }
  return name;
}

/// A message has the name of the file as the mesh says it.
std::string buffer_file_bytes(const std::filesystem::path& file, const std::string& name) {
  const auto refuse = [&](const char* reason) {
    reject(fmt::format("buffer file \"{}\": {}", host::shortened(name), reason));
  };
  std::error_code error;
  if (!std::filesystem::exists(file, error)) refuse("no such file");
  if (!std::filesystem::is_regular_file(file, error)) refuse("is not a regular file");
  host::never_replace(file.string());
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (!in || error) refuse("cannot be opened");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) refuse("cannot be read");
  return bytes;
}

/// They are read, or change no triangle and no transform of a file that is not animated. A name that ends in _
/// stands for all names that begin so.
constexpr std::array<std::string_view, 25> gltf_extensions_read{"KHR_mesh_quantization",
                                                                "EXT_mesh_gpu_instancing",
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
