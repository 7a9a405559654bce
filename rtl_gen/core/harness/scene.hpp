// The image of a scene, and rays with what a core must answer.
#pragma once

#include <array>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

#include "bits.hpp"
#include "core.hpp"
#include "features.hpp"

using Block = std::array<uint8_t, CORE_BLOCK_BYTES>;

struct Ray {
  core_ray ray;
  uint64_t number, t;           // of the nearest triangle; of any hit only whether there is one is compared
  uint64_t records, triangles;  // that it reads
  std::array<uint64_t, Episodes::numbers> more;  // that features compare
};

struct Scene {
  std::vector<Block> blocks;
  std::vector<Ray> rays;
};

// Of a hit that has not failed.
inline bool is_answer(const core_hit& hit, const Ray& ray) {
  if (ray.ray.any && !Episodes::asks_crossings(ray.ray))
    return (hit.number != CORE_NO_HIT) == (ray.number != CORE_NO_HIT);
  return hit.number == ray.number && hit.t == ray.t &&
         (hit.number == CORE_NO_HIT || Episodes::asks_crossings(ray.ray) ||
          Episodes::is_answer(hit, ray.more.data()));
}

class SceneFile {
 public:
  SceneFile() {
    if (!file_) fail(std::string(scene_file) + " cannot be read; line", 0);
  }
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;
  ~SceneFile() { std::fclose(file_); }

  Scene read() {
    Scene scene;
    for (char kind; std::fscanf(file_, " %c", &kind) == 1;) {
      if (kind == '#') {
        for (int c = 0; c != '\n' && c != EOF;) c = std::fgetc(file_);
      } else if (kind == 'b') {
        read(scene.blocks.emplace_back());
      } else {
        read(scene.rays.emplace_back());
      }
    }
    return scene;
  }

 private:
  template <class Number>
  void number(Number& number) {
    const char* const format = std::is_same_v<Number, float> ? "%f"
                               : std::is_signed_v<Number>    ? "%" SCNd64
                                                             : "%" SCNu64;
    if (std::fscanf(file_, format, &number) != 1)
      fail(std::string(scene_file) + " is cut at byte", static_cast<uint64_t>(std::ftell(file_)));
  }
  void read(Block& block) {
    for (size_t i = 0; i < block.size(); i += 8) {
      uint64_t word;
      number(word);
      for (size_t j = 0; j < 8; ++j) block[i + j] = static_cast<uint8_t>(word >> 8 * j);
    }
  }
  void read(Ray& ray) {
    each_field(ray.ray, [this](auto& field) { number(field); });
    number(ray.number);
    number(ray.t);
    number(ray.records);
    number(ray.triangles);
    for (uint64_t& each : ray.more) number(each);
  }

  std::FILE* const file_ = std::fopen(scene_file, "r");
};
