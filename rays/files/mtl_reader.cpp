#include "rays/files/mtl_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "host/files.hpp"
#include "host/outputs.hpp"
#include "host/reject.hpp"
#include "host/talk.hpp"
#include "host/text.hpp"
#include "rays/files/decimal.hpp"
#include "rays/files/obj_lines.hpp"

namespace hitpipe::ref {
namespace {

/// Within 0..1; a number that is none counts as 0.
float part(float x) {
  return std::isnan(x) ? 0.0F : std::clamp(x, 0.0F, 1.0F);
}

glm::vec3 parts(const glm::vec3& colour) {
  return {part(colour.x), part(colour.y), part(colour.z)};
}

bool is_one_of(int number, std::initializer_list<int> list) {
  return std::find(list.begin(), list.end(), number) != list.end();
}

float take_number(const ObjLines& lines, std::string_view word, std::string_view& line) {
  const std::string_view text = take_word(line);
  const std::optional<float> number = decimal<float>(text);
  if (!number) lines.fail(fmt::format("\"{}\" behind {} is not a number", host::shortened(text), word));
  return *number;
}

/// IEC 61966-2-1: a colour of CIE 1931 as the parts of linear red, green and blue.
glm::vec3 linear_rgb(const glm::vec3& xyz) {
  constexpr glm::vec3 red{3.2406F, -1.5372F, -0.4986F};
  constexpr glm::vec3 green{-0.9689F, 1.8758F, 0.0415F};
  constexpr glm::vec3 blue{0.0557F, -0.2040F, 1.0570F};
  return {glm::dot(red, xyz), glm::dot(green, xyz), glm::dot(blue, xyz)};
}

/// One number is all three.
glm::vec3 take_colour(const ObjLines& lines, std::string_view word, std::string_view& line) {
  std::string_view behind = line;
  if (take_word(behind) == "xyz") return linear_rgb(take_colour(lines, word, line = behind));
  const float red = take_number(lines, word, line);
  std::string_view ahead = line;
  if (take_word(ahead).empty()) return glm::vec3(red);
  const float green = take_number(lines, word, line);
  return {red, green, take_number(lines, word, line)};
}

int take_illum(const ObjLines& lines, std::string_view& line) {
  const std::string_view text = take_word(line);
  const std::optional<float> number = decimal<float>(text);
  if (!number || !(*number >= 0.0F && *number <= 10.0F) || *number != std::floor(*number))
    lines.fail(fmt::format("\"{}\" behind illum is no model, which are 0 to 10", host::shortened(text)));
  return static_cast<int>(*number);
}

void read_mtl_line(const ObjLines& lines, std::string_view word, std::string_view line,
                   MtlMaterial& material) {
  if (word == "Kd") material.diffuse = take_colour(lines, word, line);
  if (word == "Ks") material.specular = take_colour(lines, word, line);
  if (word == "Tf") material.filter = take_colour(lines, word, line);
  if (word == "Tr") material.transparency = take_number(lines, word, line);
  if (word == "Ni") material.index = take_number(lines, word, line);
  if (word == "illum") material.illum = take_illum(lines, line);
  if (word == "d") {
    std::string_view behind = line;
    if (take_word(behind) == "-halo") line = behind;
    material.opacity = take_number(lines, word, line);
  }
}

}  // namespace

std::vector<std::string> read_mtl(std::string_view text, MtlMaterials& materials) {
  std::vector<std::string> faults;
  ObjLines lines(text);
  MtlMaterial* material = nullptr;
  for (std::string_view line; lines.next(line);) {
    const std::string_view word = take_word(line);
    if (word == "newmtl") {
      material = &materials[std::string(rest_of(line))];
      continue;
    }
    if (!material) continue;
    try {
      read_mtl_line(lines, word, line, *material);
    } catch (const std::runtime_error& fault) {
      faults.emplace_back(fault.what());
    }
  }
  return faults;
}

void read_mtl_file(const std::filesystem::path& file, MtlMaterials& materials) {
  host::never_replace(file.string());
  const auto note = [&](const std::string& fault, const std::string& left_out) {
    host::note(one_line(fmt::format("mtl file \"{}\": {}; {} left out", file.string(), fault, left_out)));
  };
  const std::optional<std::string> text = host::contents_of(file);
  if (!text) return note("cannot be read", "its materials are");
  try {
    const std::vector<std::string> faults = read_mtl(*text, materials);
    if (faults.empty()) return;
    note(faults[0],
         faults.size() == 1 ? "this value is" : fmt::format("this value and {} more are", faults.size() - 1));
  } catch (const std::runtime_error& error) {
    note(error.what(), "its materials are");
  }
}

float MtlMaterial::opaque() const {
  return part(opacity.value_or(1.0F - transparency.value_or(0.0F)));
}

std::optional<Material> surface_of(const MtlMaterial& material) {
  if (!material.diffuse && !material.specular && !material.opacity && !material.transparency)
    return std::nullopt;
  constexpr float grey = 0.6F;  // where only other parts are given
  const int illum = material.illum.value_or(1);
  const float opaque = material.opaque();
  Material made;
  made.albedo = opaque * parts(material.diffuse.value_or(glm::vec3(grey)));
  if (is_one_of(illum, {3, 4, 5, 6, 7, 9})) made.reflect = parts(material.specular.value_or(glm::vec3(0.0F)));
  if (opaque < 1.0F) {
    made.transmit = (1.0F - opaque) * parts(material.filter.value_or(glm::vec3(1.0F)));
    const float index = material.index.value_or(1.0F);
    if (is_one_of(illum, {6, 7}) && index >= 0.1F && index <= 10.0F) made.refractive_index = index;
  }
  const glm::vec3 sum = made.albedo + made.reflect + made.transmit;
  const float most = std::max({sum.x, sum.y, sum.z});
  if (most > 1.0F) {
    made.albedo /= most;
    made.reflect /= most;
    made.transmit /= most;
  }
  return made;
}

}  // namespace hitpipe::ref
