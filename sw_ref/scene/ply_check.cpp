#include "sw_ref/scene/ply_check.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "host/text.hpp"
#include "sw_ref/reject.hpp"

namespace hitpipe::ref {
namespace {

struct Scalar {
  std::string_view name;
  int bytes;
  enum Kind { signed_int, unsigned_int, floating } kind;
};
constexpr std::array<Scalar, 16> scalars{{{"char", 1, Scalar::signed_int},
                                          {"int8", 1, Scalar::signed_int},
                                          {"uchar", 1, Scalar::unsigned_int},
                                          {"uint8", 1, Scalar::unsigned_int},
                                          {"short", 2, Scalar::signed_int},
                                          {"int16", 2, Scalar::signed_int},
                                          {"ushort", 2, Scalar::unsigned_int},
                                          {"uint16", 2, Scalar::unsigned_int},
                                          {"int", 4, Scalar::signed_int},
                                          {"int32", 4, Scalar::signed_int},
                                          {"uint", 4, Scalar::unsigned_int},
                                          {"uint32", 4, Scalar::unsigned_int},
                                          {"float", 4, Scalar::floating},
                                          {"float32", 4, Scalar::floating},
                                          {"double", 8, Scalar::floating},
                                          {"float64", 8, Scalar::floating}}};

struct Property {
  std::string name;
  std::optional<Scalar> count;  // of a list
  Scalar type;
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

enum class DataFormat { text, little_endian, big_endian };

struct Header {
  DataFormat encoding;
  std::vector<Element> elements;
};

/// One header line without the blanks at its end. If a line is longer than this, the file is not PLY.
std::string header_line(std::istream& in) {
  constexpr std::size_t longest = 4096;
  std::string line;
  for (char c; in.get(c) && c != '\n';) {
    line.push_back(c);
    if (line.size() > longest) reject("the PLY header has a line of more than 4096 characters");
  }
  if (!in) reject("the PLY header has no end; \"end_header\" must follow the properties");
  line.resize(line.find_last_not_of(" \t\r") + 1);
  return line;
}

Scalar scalar_named(const std::string& name) {
  const auto* const found =
      std::find_if(scalars.begin(), scalars.end(), [&](const Scalar& s) { return s.name == name; });
  if (found == scalars.end())
    reject(fmt::format(
        "unknown PLY type \"{}\"; allowed are char, uchar, short, ushort, int, uint, float, double",
        host::shortened(name)));
  return *found;
}

Element parse_element(std::istringstream& words) {
  Element element;
  std::string count;
  words >> element.name >> count;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (element.name.empty() || error != std::errc{} || end != count.data() + count.size() ||
      element.count > UINT32_MAX)
    reject(fmt::format("PLY element \"{}\" has the count \"{}\"; allowed are 0 to 4294967295",
                       host::shortened(element.name), host::shortened(count)));
  if (element.name == "tristrips")
    reject("PLY triangle strips are not read; give the triangles as element face");
  return element;
}

Property parse_property(std::istringstream& words) {
  Property property;
  std::string type;
  words >> type;
  if (type == "list") {
    std::string count;
    words >> count >> type;
    property.count = scalar_named(count);
    if (property.count->kind == Scalar::floating)
      reject(
          fmt::format("a PLY list is counted in \"{}\"; allowed are integer types", host::shortened(count)));
  }
  property.type = scalar_named(type);
  words >> property.name;
  return property;
}

Header parse_header(std::istream& in) {
  if (header_line(in) != "ply") reject("the file does not begin with the line \"ply\"");
  std::istringstream format(header_line(in));
  std::string keyword;
  std::string encoding;
  format >> keyword >> encoding;
  Header header{};
  if (keyword == "format" && encoding == "ascii")
    header.encoding = DataFormat::text;
  else if (keyword == "format" && encoding == "binary_little_endian")
    header.encoding = DataFormat::little_endian;
  else if (keyword == "format" && encoding == "binary_big_endian")
    header.encoding = DataFormat::big_endian;
  else
    reject("the second line must be \"format\" with ascii, binary_little_endian or binary_big_endian");
  for (;;) {
    std::istringstream words(header_line(in));
    keyword.clear();
    words >> keyword;
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "element")
      header.elements.push_back(parse_element(words));
    else if (keyword == "property" && !header.elements.empty())
      header.elements.back().properties.push_back(parse_property(words));
    else
      reject(fmt::format(
          "unexpected word \"{}\" in the PLY header; allowed are comment, obj_info, element, property "
          "and end_header",
          host::shortened(keyword)));
  }
  return header;
}

bool is_vertex_list(const Element& element, const Property& property) {
  return element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool has_coordinates(const Element& element) {
  const auto has = [&](std::string_view name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const Property& p) { return p.name == name && !p.count; });
  };
  return has("x") && has("y") && has("z");
}

bool has_vertex_list(const Element& element) {
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [&](const Property& p) { return is_vertex_list(element, p) && p.count; });
}

/// There must be one element of vertices with x, y, z, followed by one element of faces with a vertex list.
/// Returns the number of vertices.
std::uint64_t check_elements(const Header& header) {
  std::string order;
  std::uint64_t vertices = 0;
  for (const Element& element : header.elements) {
    if (element.properties.empty())
      reject(fmt::format("PLY element \"{}\" has no property", host::shortened(element.name)));
    if (element.name == "vertex" && has_coordinates(element)) {
      order += "vertex ";
      vertices = element.count;
    } else if (element.name == "vertex" || element.name == "face") {
      order += has_vertex_list(element) ? "face " : "other ";
    }
  }
  if (order != "vertex face ")
    reject(
        "the PLY header must announce one element vertex with x, y, z, then one element face with a list "
        "vertex_indices");
  return vertices;
}

/// Values of a binary body, one after the other.
class BinaryBody {
 public:
  BinaryBody(std::istream& in, bool little_endian)
      : in_(in), swap_(little_endian != (std::endian::native == std::endian::little)) {}

  void begin_row() {}

  /// False at the end of the file.
  bool next(const Scalar& type, double& value) {
    std::array<char, 8> bytes{};
    const auto size = static_cast<std::size_t>(type.bytes);
    if (in_.rdbuf()->sgetn(bytes.data(), type.bytes) != type.bytes) return false;
    if (swap_) std::reverse(bytes.begin(), bytes.begin() + type.bytes);
    if (type.kind == Scalar::floating) {
      value = size == 4 ? static_cast<double>(read<float>(bytes)) : read<double>(bytes);
    } else if (type.kind == Scalar::signed_int) {
      value = size == 1   ? read<std::int8_t>(bytes)
              : size == 2 ? read<std::int16_t>(bytes)
                          : read<std::int32_t>(bytes);
    } else {
      value = size == 1   ? read<std::uint8_t>(bytes)
              : size == 2 ? read<std::uint16_t>(bytes)
                          : read<std::uint32_t>(bytes);
    }
    return true;
  }

 private:
  template <class T>
  static T read(const std::array<char, 8>& bytes) {
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  std::istream& in_;
  bool swap_;
};

/// Values of a text body: one row per element, blanks between values.
class TextBody {
 public:
  explicit TextBody(std::istream& in) : in_(in) {}

  void begin_row() {
    line_.clear();
    std::getline(in_, line_);
    at_ = line_.data();
  }

  /// False at the end of the row.
  bool next(const Scalar&, double& value) {
    const char* const end = line_.data() + line_.size();
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    at_ = std::find_if_not(at_, end, is_blank);
    if (at_ == end) return false;
    const char* const word_end = std::find_if(at_, end, is_blank);
    const auto [stop, error] = std::from_chars(*at_ == '+' ? at_ + 1 : at_, word_end, value);
    // A number out of range is still a number. Assimp makes it zero or infinite, and infinity is rejected
    // later.
    if (stop != word_end || error == std::errc::invalid_argument)
      reject(fmt::format("\"{}\" is not a number",
                         host::shortened({at_, static_cast<std::size_t>(word_end - at_)})));
    at_ = word_end;
    return true;
  }

 private:
  std::istream& in_;
  std::string line_;
  const char* at_ = nullptr;
};

template <class Body>
void walk(const Header& header, std::uint64_t vertices, Body body) {
  for (const Element& element : header.elements) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      const auto next = [&](const Scalar& type) {
        double value = 0;
        if (!body.next(type, value))
          reject(fmt::format("cut short in element {} {}; the header announces {}",
                             host::shortened(element.name), i, element.count));
        return value;
      };
      body.begin_row();
      for (const Property& property : element.properties) {
        if (!property.count) {
          next(property.type);
          continue;
        }
        const double entries = next(*property.count);
        if (!(entries >= 0) || entries != std::floor(entries))
          reject(fmt::format("element {} {} has a list of {} entries; allowed are 0 and more",
                             host::shortened(element.name), i, entries));
        for (double entry = 0; entry < entries; ++entry) {
          const double index = next(property.type);
          if (is_vertex_list(element, property) && !(index >= 0 && index < static_cast<double>(vertices)))
            reject(fmt::format("face {} refers to vertex {}; the file has vertices 0 to {}", i, index,
                               static_cast<std::int64_t>(vertices) - 1));
        }
      }
    }
  }
}

}  // namespace

void check_ply(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) reject("cannot be opened; give a file that can be read");
  const Header header = parse_header(in);
  const std::uint64_t vertices = check_elements(header);
  if (header.encoding == DataFormat::text)
    walk(header, vertices, TextBody(in));
  else
    walk(header, vertices, BinaryBody(in, header.encoding == DataFormat::little_endian));
}

}  // namespace hitpipe::ref
