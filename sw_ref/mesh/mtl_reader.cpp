#include "sw_ref/mesh/mtl_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "host/outputs.hpp"
#include "host/text.hpp"
#include "sw_ref/mesh/decimal.hpp"
#include "sw_ref/mesh/obj_lines.hpp"

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
  if (!number)
    lines.fail(fmt::format("\"{}\" behind {} is not a number; allowed are decimal numbers such as 0.5",
                           host::shortened(text), word));
  return *number;
}

/// One number is all three.
glm::vec3 take_colour(const ObjLines& lines, std::string_view word, std::string_view& line) {
  const float red = take_number(lines, word, line);
  std::string_view ahead = line;
  if (take_word(ahead).empty()) return glm::vec3(red);
  const float green = take_number(lines, word, line);
  return {red, green, take_number(lines, word, line)};
}

int take_illum(const ObjLines& lines, std::string_view& line) {
  const std::string_view text = take_word(line);
  const std::optional<int> number = host::number_in<int>(text);
  if (!number || *number < 0 || *number > 10)
    lines.fail(fmt::format("\"{}\" behind illum is no model; allowed are 0 to 10", host::shortened(text)));
  return *number;
}

}  // namespace

void read_mtl(std::string_view text, MtlMaterials& materials) {
  ObjLines lines(text);
  MtlMaterial* material = nullptr;
  for (std::string_view line; lines.next(line);) {
    const std::string_view word = take_word(line);
    if (word == "newmtl") {
      material = &materials[std::string(rest_of(line))];
      continue;
    }
    if (!material) continue;
    if (word == "Kd") material->diffuse = take_colour(lines, word, line);
    if (word == "Ks") material->specular = take_colour(lines, word, line);
    if (word == "Tf") material->filter = take_colour(lines, word, line);
    if (word == "Tr") material->opacity = 1.0F - take_number(lines, word, line);
    if (word == "Ni") material->index = take_number(lines, word, line);
    if (word == "illum") material->illum = take_illum(lines, line);
    if (word == "d") {
      std::string_view behind = line;
      if (take_word(behind) == "-halo") line = behind;
      material->opacity = take_number(lines, word, line);
    }
  }
}

void read_mtl_file(const std::filesystem::path& file, MtlMaterials& materials) {
  host::never_replace(file.string());
  try {
    std::ifstream in(file, std::ios::binary);
    if (!in) reject("cannot be opened; give a file that can be read");
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    read_mtl(text, materials);
  } catch (const std::runtime_error& error) {
    reject(fmt::format("mtl file \"{}\": {}", file.string(), error.what()));
  }
}

std::optional<Material> surface_of(const MtlMaterial& material) {
  if (!material.diffuse && !material.specular && !material.opacity) return std::nullopt;
  constexpr float grey = 0.6F;  // where only other parts are given
  const int illum = material.illum.value_or(1);
  const float opaque = part(material.opacity.value_or(1.0F));
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
