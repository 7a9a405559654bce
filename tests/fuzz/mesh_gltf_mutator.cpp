// Changes glTF and GLB files as JSON: values, types, members and elements, so that most inputs get past the
// parser. Every fourth input is changed as bytes.
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using Json = nlohmann::json;
using Random = std::minstd_rand;

constexpr std::string_view extension = HITPIPE_EXTENSION;
constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;

std::size_t below(Random& random, std::size_t count) {
  return random() % count;
}

Json some_value(Random& random) {
  static const std::vector<Json> values{nullptr,
                                        true,
                                        false,
                                        0,
                                        1,
                                        2,
                                        3,
                                        4,
                                        5,
                                        6,
                                        -1,
                                        255,
                                        65535,
                                        2147483647,
                                        4294967295U,
                                        1e308,
                                        -0.5,
                                        5120,
                                        5121,
                                        5122,
                                        5123,
                                        5125,
                                        5126,
                                        "",
                                        "VEC3",
                                        "SCALAR",
                                        "MAT4",
                                        "%zz",
                                        "../a",
                                        "data:;base64,AAAA",
                                        "data:application/octet-stream;base64,AACAPwAAgD8=",
                                        Json::array(),
                                        Json::object(),
                                        Json::array({0}),
                                        Json::array({0, 0, 0}),
                                        Json::array({1, 2, 3, 4}),
                                        Json::array({"KHR_mesh_quantization"}),
                                        Json::array({"EXT_unknown"})};
  return values[below(random, values.size())];
}

std::string some_name(Random& random) {
  static const std::vector<std::string> names{"asset",
                                              "version",
                                              "scene",
                                              "scenes",
                                              "nodes",
                                              "children",
                                              "mesh",
                                              "meshes",
                                              "skin",
                                              "skins",
                                              "joints",
                                              "primitives",
                                              "attributes",
                                              "POSITION",
                                              "NORMAL",
                                              "indices",
                                              "mode",
                                              "targets",
                                              "weights",
                                              "material",
                                              "accessors",
                                              "bufferView",
                                              "count",
                                              "type",
                                              "sparse",
                                              "values",
                                              "byteOffset",
                                              "componentType",
                                              "normalized",
                                              "bufferViews",
                                              "buffer",
                                              "buffers",
                                              "byteStride",
                                              "byteLength",
                                              "uri",
                                              "matrix",
                                              "translation",
                                              "rotation",
                                              "scale",
                                              "extensions",
                                              "extensionsUsed",
                                              "extensionsRequired",
                                              "inverseBindMatrices",
                                              "EXT_mesh_gpu_instancing"};
  return names[below(random, names.size())];
}

/// All values below this one, but not more than some thousand.
std::vector<Json*> values_in(Json& whole) {
  constexpr std::size_t most = 4000;
  std::vector<Json*> all{&whole};
  for (std::size_t i = 0; i < all.size() && all.size() < most; ++i)
    if (all[i]->is_structured())
      for (Json& value : *all[i]) all.push_back(&value);
  return all;
}

void change(Json& whole, Random& random) {
  const std::vector<Json*> values = values_in(whole);
  Json& value = *values[below(random, values.size())];
  const auto member = [&] {
    auto at = value.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(below(random, value.size())));
    return at;
  };
  switch (below(random, 6)) {
    case 0:
      value = some_value(random);
      break;
    case 1:
      if (value.is_structured() && !value.empty()) value.erase(member());
      break;
    case 2:
      if (value.is_array() && value.size() < 64)
        value.push_back(value.empty() ? some_value(random) : *member());
      break;
    case 3:
      value = Json(*values[below(random, values.size())]);
      break;
    case 4:
      if (value.is_object()) value[some_name(random)] = some_value(random);
      break;
    default:
      if (value.is_number_integer())
        value = value.get<std::int64_t>() + static_cast<int>(below(random, 5)) - 2;
      break;
  }
}

std::string word(std::size_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  return {static_cast<char>(bits), static_cast<char>(bits >> 8U), static_cast<char>(bits >> 16U),
          static_cast<char>(bits >> 24U)};
}

std::size_t word_at(std::string_view bytes, std::size_t place) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[place + i]);
  return value;
}

/// The JSON of the file, and the bytes behind its chunk.
std::pair<std::string_view, std::string_view> parts_of(std::string_view bytes) {
  if (extension != "glb") return {bytes, ""};
  const std::size_t begin = header_bytes + chunk_header_bytes;
  if (bytes.size() < begin) return {"", ""};
  const std::size_t length = word_at(bytes, header_bytes);
  if (length > bytes.size() - begin) return {"", ""};
  return {bytes.substr(begin, length), bytes.substr(begin + length)};
}

std::string joined(std::string json, std::string_view rest) {
  if (extension != "glb") return json;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t length = header_bytes + chunk_header_bytes + json.size() + rest.size();
  std::string file = "glTF" + word(2) + word(length) + word(json.size()) + "JSON" + json;
  return file.append(rest);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  Random random(seed);
  const std::string before(reinterpret_cast<const char*>(data), size);
  const auto [text, rest] = parts_of(before);
  Json json = Json::parse(text, nullptr, false);
  if (below(random, 4) == 0 || json.is_discarded()) return LLVMFuzzerMutate(data, size, most);
  for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) change(json, random);
  const std::string after = joined(json.dump(-1, ' ', false, Json::error_handler_t::replace), rest);
  if (after.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, after.data(), after.size());
  return after.size();
}
