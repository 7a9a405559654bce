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

using Block = std::array<uint8_t, CORE_BLOCK_BYTES>;

struct Ray {
  core_ray ray;
  uint64_t number, t;           // of the nearest triangle; of any hit only whether there is one is compared
  uint64_t records, triangles;  // that it reads
#if HARNESS_WEIGHTS
  uint64_t weights[6];  // |det|, |u| and |v| of a hit, the high half first
#endif
};

struct Scene {
  std::vector<Block> blocks;
  std::vector<Ray> rays;
};

// Whether a ray asks for crossings, which are counted or come one after the other.
inline bool asks_crossings([[maybe_unused]] const core_ray& ray) {
#if HARNESS_QUESTIONS
  return ray.once != 0;
#else
  return false;
#endif
}

// The core says of it that it is none.
inline core_ray spoilt(core_ray ray) {
#if HARNESS_FLOAT_DOOR
  ray.dx = ray.dy = ray.dz = 0;
#else
  ray.error = 1;
#endif
  return ray;
}

#if HARNESS_WEIGHTS
// A number with a sign in two halves has that size.
inline bool is_size(int64_t high, uint64_t low, int low_bits, const uint64_t* size) {
  const uint64_t mask = (uint64_t{1} << low_bits) - 1;
  if (high < 0) {
    low = (~low + 1) & mask;
    high = low == 0 ? -high : ~high;
  }
  return static_cast<uint64_t>(high) == size[0] && low == size[1];
}
inline bool has_weights(const core_hit& hit, const Ray& ray) {
  if (hit.number == CORE_NO_HIT || asks_crossings(ray.ray)) return true;
  return is_size(hit.det_high, hit.det_low, det_low_bits, ray.weights) &&
         is_size(hit.u_high, hit.u_low, edge_low_bits, ray.weights + 2) &&
         is_size(hit.v_high, hit.v_low, edge_low_bits, ray.weights + 4);
}
#else
inline bool has_weights(const core_hit&, const Ray&) {
  return true;
}
#endif

// Of a hit that has not failed.
inline bool is_answer(const core_hit& hit, const Ray& ray) {
  if (ray.ray.any && !asks_crossings(ray.ray))
    return (hit.number != CORE_NO_HIT) == (ray.number != CORE_NO_HIT);
  return hit.number == ray.number && hit.t == ray.t && has_weights(hit, ray);
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
#if HARNESS_WEIGHTS
    for (uint64_t& half : ray.weights) number(half);
#endif
  }

  std::FILE* const file_ = std::fopen(scene_file, "r");
};
