#include "sw_ref/scene/obj_material.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <assimp/material.h>
#include <glm/common.hpp>

namespace hitpipe::ref {
namespace {

/// Within 0..1; a number that is none counts as 0.
float part(float x) {
  return std::isnan(x) ? 0.0F : std::clamp(x, 0.0F, 1.0F);
}

glm::vec3 colour(const aiMaterial& material, const char* key, glm::vec3 otherwise) {
  aiColor3D c;
  if (material.Get(key, 0, 0, c) != aiReturn_SUCCESS) return otherwise;
  return {part(c.r), part(c.g), part(c.b)};
}

template <class Number>
Number number(const aiMaterial& material, const char* key, Number otherwise) {
  Number value = otherwise;
  return material.Get(key, 0, 0, value) == aiReturn_SUCCESS ? value : otherwise;
}

bool is_one_of(int number, std::initializer_list<int> list) {
  return std::find(list.begin(), list.end(), number) != list.end();
}

/// Assimp fills in these values when no MTL file defines a name that `usemtl` uses.
bool says_nothing(const aiMaterial& material) {
  return colour(material, "$clr.diffuse", glm::vec3(0.6F)) == glm::vec3(0.6F) &&
         colour(material, "$clr.specular", glm::vec3(0.0F)) == glm::vec3(0.0F) &&
         number(material, "$mat.shininess", 0.0F) == 0.0F && number(material, "$mat.opacity", 1.0F) == 1.0F;
}

}  // namespace

std::optional<Material> obj_material(const aiMaterial& material) {
  if (says_nothing(material)) return std::nullopt;
  const int illum = number(material, "$mat.illum", 1);
  const float opaque = part(number(material, "$mat.opacity", 1.0F));
  Material made;
  made.albedo = opaque * colour(material, "$clr.diffuse", glm::vec3(0.7F));
  if (is_one_of(illum, {3, 4, 5, 6, 7, 9})) made.reflect = colour(material, "$clr.specular", glm::vec3(0.0F));
  if (opaque < 1.0F) {
    made.transmit = (1.0F - opaque) * colour(material, "$clr.transparent", glm::vec3(1.0F));
    const float index = number(material, "$mat.refracti", 1.0F);
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
