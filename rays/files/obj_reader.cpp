#include "rays/files/obj_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/talk.hpp"
#include "host/text.hpp"
#include "rays/files/bad_positions.hpp"
#include "rays/files/decimal.hpp"
#include "rays/files/finite.hpp"
#include "rays/files/mtl_reader.hpp"
#include "rays/files/obj_lines.hpp"
#include "rays/files/obj_words.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::size_t most_places = std::numeric_limits<std::uint32_t>::max();

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::filesystem::path& file)
      : lines_(text), file_(file), most_names_((std::size_t{1} << 24U) + 8 * text.size()) {}

  FileMesh read() {
    for (std::string_view line; lines_.next(line);) {
      const std::string_view word = take_word(line);
      if (word == "v")
        add_position(line);
      else if (word == "f" || word == "fo")
        add_face(line);
      else if (word == "g" || word == "o")
        name_ = rest_of(line);
      else if (word == "usemtl")
        use_material(rest_of(line));
      else if (word == "mtllib")
        read_materials(rest_of(line));
      else if (is_among(obj_refused, word))
        lines_.fail(fmt::format("\"{}\" is not read; give the geometry as faces (f)", word));
      else if (!word.empty() && !is_among(obj_skipped, word))
        lines_.fail(fmt::format("unknown word \"{}\"; allowed are those of Wavefront's OBJ specification",
                                host::shortened(word)));
    }
    if (farthest_ > mesh_.positions.size())
      reject(fmt::format("line {}: a face refers to vertex {}; the file has {}", farthest_line_, farthest_,
                         vertices()));
    bad_.refuse_used(mesh_, [&](std::size_t vertex, std::size_t line) {
      const glm::dvec3& p = mesh_.positions[vertex];
      reject(fmt::format("line {}: a vertex lies at ({}, {}, {}); coordinates must be finite", line, p.x, p.y,
                         p.z));
    });
    for (FileMesh::Group& group : mesh_.groups) group.surface = surface(group.material);
    note_transparent();
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::string vertices() const {
    const std::size_t n = mesh_.positions.size();
    return n == 0 ? "no vertex" : n == 1 ? "vertex 1" : fmt::format("vertices 1 to {}", n);
  }

  void add_position(std::string_view line) {
    constexpr std::size_t most = 7;
    std::array<double, most> numbers{};
    std::size_t count = 0;
    for (std::string_view word; !(word = take_word(line)).empty(); ++count) {
      const std::optional<double> number = decimal<double>(word);
      if (!number)
        lines_.fail(fmt::format("\"{}\" is not a number; allowed are decimal numbers such as -1.5e3",
                                host::shortened(word)));
      if (count < most) numbers[count] = *number;
    }
    if (count != 3 && count != 4 && count != 6 && count != 7)
      lines_.fail(fmt::format("a vertex has {} numbers; allowed are 3, with a weight 4, with a colour 6 or 7",
                              count));
    const glm::dvec3 position(numbers[0], numbers[1], numbers[2]);
    if (!has_finite_coordinates(position)) bad_.add(mesh_.positions.size(), lines_.number());
    if (mesh_.positions.size() == most_places) lines_.fail("has more than 4294967295 vertices");
    mesh_.positions.push_back(position);
  }

  /// Takes a whole number from the front of a word. One that is too large counts as the largest.
  static std::optional<std::int64_t> take_index(std::string_view& word) {
    std::string_view digits = word;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    std::int64_t index = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc::result_out_of_range)
      index = digits.starts_with('-') ? std::numeric_limits<std::int64_t>::min()
                                      : std::numeric_limits<std::int64_t>::max();
    word = {stop, static_cast<std::size_t>(word.data() + word.size() - stop)};
    return index;
  }

  /// The place of the position of a corner v, v/vt, v//vn or v/vt/vn.
  std::uint32_t place(std::string_view corner) {
    std::string_view rest = corner;
    const std::optional<std::int64_t> index = take_index(rest);
    bool good = index.has_value();
    for (int part = 0; part < 2 && good && rest.starts_with('/'); ++part) {
      rest.remove_prefix(1);
      if (!rest.empty() && rest.front() != '/') good = take_index(rest).has_value();
    }
    if (!good || !rest.empty())
      lines_.fail(fmt::format(
          "\"{}\" is no corner of a face; allowed are v, v/vt, v//vn and v/vt/vn with whole numbers",
          host::shortened(corner)));
    const auto known = static_cast<std::int64_t>(mesh_.positions.size());
    if (*index == 0)
      lines_.fail("a face refers to vertex 0; the first has number 1, and the last before a line number -1");
    if (*index < -known)
      lines_.fail(fmt::format("a face refers to vertex {}; {} are before this line", *index, known));
    if (*index < 0) return static_cast<std::uint32_t>(known + *index);
    if (*index > known && static_cast<std::uint64_t>(*index) > farthest_) {
      farthest_ = static_cast<std::uint64_t>(*index);
      farthest_line_ = lines_.number();
    }
    return static_cast<std::uint32_t>(*index - 1);
  }

  void add_face(std::string_view line) {
    corners_.clear();
    for (std::string_view word; !(word = take_word(line)).empty();) corners_.push_back(place(word));
    if (corners_.empty()) lines_.fail("a face has no corner; allowed are 1 and more");
    if (mesh_.corners.size() + corners_.size() > most_places)
      lines_.fail("the faces have more than 4294967295 corners");
    if (mesh_.groups.empty() || mesh_.groups.back().name != name_ ||
        mesh_.groups.back().material != material_) {
      // Each group has a copy of its names.
      names_ += name_.size() + material_.size();
      if (names_ > most_names_) lines_.fail("the names of groups are too long for this file");
      mesh_.groups.push_back({std::string(name_), std::string(material_), {}, mesh_.faces()});
    }
    mesh_.add_face(corners_);
  }

  void use_material(std::string_view name) {
    if (!name.empty()) material_ = name;
  }

  /// The specification allows several names on a line, exporters write names with blanks.
  void read_materials(std::string_view names) {
    if (read_library(names)) return;
    bool found = false;
    for (std::string_view word; !(word = take_word(names)).empty();) found |= read_library(word);
    if (found) return;
    std::filesystem::path own = file_;
    (void)read_library(own.replace_extension(".mtl").filename().string());
  }

  /// False if there is no such file.
  bool read_library(std::string_view name) {
    std::string slashes(name);
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    for (const std::string& spelling : {std::string(name), slashes}) {
      const std::filesystem::path mtl = file_.parent_path() / spelling;
      std::error_code error;
      if (spelling.empty() || !std::filesystem::is_regular_file(mtl, error)) continue;
      if (read_files_.insert(mtl.string()).second) read_mtl_file(mtl, materials_);
      return true;
    }
    return false;
  }

  /// A name may hold a #. If no file defines it, the # begins a comment.
  [[nodiscard]] std::optional<Material> surface(std::string& name) {
    auto found = materials_.find(name);
    if (found == materials_.end()) {
      const std::size_t comment = name.find(" #");
      if (comment == std::string::npos) return std::nullopt;
      found = materials_.find(std::string(rest_of(std::string_view(name).substr(0, comment))));
      if (found == materials_.end()) return std::nullopt;
      name = found->first;
    }
    const MtlMaterial& material = found->second;
    if (!material.opacity && material.opaque() < 1.0F) transparent_.insert(found->first);
    return surface_of(material);
  }

  /// Some programs write Tr 1 for opaque materials.
  void note_transparent() const {
    if (transparent_.empty()) return;
    const std::string& name = *transparent_.begin();
    const MtlMaterial& material = materials_.at(name);
    host::note(one_line(fmt::format(
        "mesh file \"{}\": material \"{}\" is {}transparent, as it has Tr {} and no d; write d 1 if it is "
        "opaque{}",
        file_.string(), host::shortened(name), material.opaque() > 0.0F ? "" : "wholly ",
        material.transparency.value_or(0.0F),
        transparent_.size() == 1 ? "" : fmt::format("; {} more are like it", transparent_.size() - 1))));
  }

  ObjLines lines_;
  const std::filesystem::path& file_;
  std::size_t most_names_;  // bytes
  std::size_t names_ = 0;
  FileMesh mesh_;
  BadPositions bad_;
  std::vector<std::uint32_t> corners_;
  std::string name_;
  std::string material_;
  MtlMaterials materials_;
  std::set<std::string> read_files_;
  std::set<std::string> transparent_;  // materials of faces, by Tr alone
  // A face may stand before its vertices. The largest index that did:
  std::uint64_t farthest_ = 0;
  std::size_t farthest_line_ = 0;
};

}  // namespace

FileMesh read_obj(std::string_view text, const std::filesystem::path& file) {
  return ObjReader(text, file).read();
}

}  // namespace hitpipe::ref
