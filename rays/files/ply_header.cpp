#include "rays/files/ply_header.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "host/text.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::array<PlyScalar, 16> ply_scalars{{{"char", 1, PlyScalar::signed_int},
                                                 {"int8", 1, PlyScalar::signed_int},
                                                 {"uchar", 1, PlyScalar::unsigned_int},
                                                 {"uint8", 1, PlyScalar::unsigned_int},
                                                 {"short", 2, PlyScalar::signed_int},
                                                 {"int16", 2, PlyScalar::signed_int},
                                                 {"ushort", 2, PlyScalar::unsigned_int},
                                                 {"uint16", 2, PlyScalar::unsigned_int},
                                                 {"int", 4, PlyScalar::signed_int},
                                                 {"int32", 4, PlyScalar::signed_int},
                                                 {"uint", 4, PlyScalar::unsigned_int},
                                                 {"uint32", 4, PlyScalar::unsigned_int},
                                                 {"float", 4, PlyScalar::floating},
                                                 {"float32", 4, PlyScalar::floating},
                                                 {"double", 8, PlyScalar::floating},
                                                 {"float64", 8, PlyScalar::floating}}};

class PlyHeaderLines {
 public:
  explicit PlyHeaderLines(std::string_view bytes) : bytes_(bytes) {
    const std::size_t first = bytes.find_first_of("\r\n");
    if (first != std::string_view::npos && bytes[first] == '\r' && bytes.substr(first + 1, 1) != "\n")
      end_ = '\r';
  }

  /// The words of the next line. If a line is longer than this, the file is not PLY.
  std::vector<std::string> next() {
    constexpr std::size_t longest = 4096;
    const std::string_view rest = bytes_.substr(at_);
    const std::size_t length = rest.substr(0, longest + 1).find(end_);
    if (length == std::string_view::npos)
      reject(rest.size() > longest ? "the PLY header has a line of more than 4096 characters"
                                   : "the PLY header has no end; \"end_header\" must follow the properties");
    at_ += length + 1;
    ++line_;
    return host::words_of(rest.substr(0, length));
  }
  [[nodiscard]] std::size_t bytes() const { return at_; }
  [[nodiscard]] std::size_t lines() const { return line_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
  char end_ = '\n';
};

PlyScalar ply_scalar(const std::string& name) {
  const auto* const found = std::find_if(ply_scalars.begin(), ply_scalars.end(),
                                         [&](const PlyScalar& s) { return s.name == name; });
  if (found == ply_scalars.end())
    reject(fmt::format(
        "unknown PLY type \"{}\"; allowed are char, uchar, short, ushort, int, uint, float, double",
        host::shortened(name)));
  return *found;
}

void read_ply_format(PlyHeader& header, const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 3> encodings{"ascii", "binary_little_endian", "binary_big_endian"};
  const std::string encoding = words.size() > 1 && words[0] == "format" ? words[1] : "";
  const auto* const found = std::find(encodings.begin(), encodings.end(), encoding);
  if (found == encodings.end())
    reject("the second line must be \"format\" with ascii, binary_little_endian or binary_big_endian");
  header.encoding = static_cast<PlyHeader::Encoding>(found - encodings.begin());
  if (words.size() != 3 || words[2] != "1.0")
    reject(fmt::format("PLY version \"{}\" is not read; allowed is 1.0",
                       words.size() > 2 ? host::shortened(words[2]) : ""));
}

PlyElement ply_element(const std::vector<std::string>& words) {
  PlyElement element;
  element.name = words.size() > 1 ? words[1] : "";
  const std::string count = words.size() > 2 ? words[2] : "";
  const auto number = host::number_in<std::uint64_t>(count);
  if (element.name.empty() || !number || *number > UINT32_MAX)
    reject(fmt::format("PLY element \"{}\" has the count \"{}\"; allowed are 0 to 4294967295",
                       host::shortened(element.name), host::shortened(count)));
  element.count = *number;
  if (element.name == "tristrips")
    reject("PLY triangle strips are not read; give the triangles as element face");
  return element;
}

PlyProperty ply_property(const std::vector<std::string>& words) {
  const bool list = words.size() > 1 && words[1] == "list";
  const std::size_t size = list ? 5 : 3;
  PlyProperty property{};
  if (list && words.size() > 2) {
    property.count = ply_scalar(words[2]);
    if (property.count->kind == PlyScalar::floating)
      reject(fmt::format("a PLY list is counted in \"{}\"; allowed are integer types",
                         host::shortened(words[2])));
  }
  if (words.size() + 1 >= size) property.type = ply_scalar(words[size - 2]);
  if (words.size() < size) reject("a PLY property has no name; give type and name");
  property.name = words[size - 1];
  return property;
}

bool has_coordinates(const PlyElement& element) {
  const std::string_view axes = "xyz";
  return std::all_of(axes.begin(), axes.end(), [&](char axis) {
    return std::any_of(element.properties.begin(), element.properties.end(), [&](const PlyProperty& p) {
      return p.name.size() == 1 && p.name[0] == axis && !p.count;
    });
  });
}

bool has_vertex_list(const PlyElement& element) {
  return std::any_of(element.properties.begin(), element.properties.end(), is_ply_vertex_list);
}

/// x, y, z and the vertex list stand once, and a vertex list holds integers.
void check_needed_properties(const PlyElement& element) {
  const bool vertex = element.name == "vertex";
  if (!vertex && element.name != "face") return;
  std::vector<std::string> seen;
  for (const PlyProperty& property : element.properties) {
    const bool needed = vertex ? property.name == "x" || property.name == "y" || property.name == "z"
                               : is_ply_vertex_list(property);
    if (!needed) continue;
    const std::string name = vertex ? property.name : "vertex_indices";
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
      reject(fmt::format("PLY element \"{}\" has the property \"{}\" twice", element.name, name));
    seen.push_back(name);
    if (!vertex && property.type.kind == PlyScalar::floating)
      reject(fmt::format("PLY list \"{}\" has the type \"{}\"; allowed are integer types", property.name,
                         property.type.name));
  }
}

void check_ply_elements(const PlyHeader& header) {
  int vertex_elements = 0;
  int face_elements = 0;
  bool complete = true;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty())
      reject(fmt::format("PLY element \"{}\" has no property", host::shortened(element.name)));
    check_needed_properties(element);
    if (element.name == "vertex") {
      ++vertex_elements;
      complete = complete && has_coordinates(element);
    } else if (element.name == "face") {
      ++face_elements;
      complete = complete && has_vertex_list(element);
    }
  }
  if (vertex_elements != 1 || face_elements != 1 || !complete)
    reject(
        "the PLY header must announce one element vertex with x, y, z and one element face with a list "
        "vertex_indices");
}

}  // namespace

bool is_ply_vertex_list(const PlyProperty& property) {
  return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

PlyHeader read_ply_header(std::string_view bytes) {
  PlyHeaderLines lines(bytes);
  if (!bytes.starts_with("ply") || lines.next() != std::vector<std::string>{"ply"})
    reject("the file does not begin with the line \"ply\"");
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    const std::vector<std::string> words = lines.next();
    const std::string keyword = words.empty() ? "" : words[0];
    if (keyword == "comment" || keyword == "obj_info") continue;
    std::size_t expected = 3;
    if (!has_format) {
      read_ply_format(header, words);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(ply_element(words));
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(ply_property(words));
      if (header.elements.back().properties.back().count) expected = 5;
    } else if (keyword == "end_header") {
      expected = 1;
    } else {
      reject(fmt::format(
          "unexpected word \"{}\" in the PLY header; allowed are comment, obj_info, element, property "
          "and end_header",
          host::shortened(keyword)));
    }
    if (words.size() > expected)
      reject(
          fmt::format("unexpected word \"{}\" in line {} of the PLY header; allowed is the end of the line",
                      host::shortened(words[expected]), lines.lines()));
    if (keyword == "end_header") break;
  }
  header.bytes = lines.bytes();
  header.lines = lines.lines();
  check_ply_elements(header);
  return header;
}

}  // namespace hitpipe::ref
