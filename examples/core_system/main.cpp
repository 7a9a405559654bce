// A picture by the core: core_system scene.bin picture.pgm. It shows the scene `spheres` of hitpipe.
#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "driver.h"

uint32_t place_image(const char* file_name);  // the system puts the file into memory, and says where

constexpr int width = 160, height = 120, pixels = width * height;  // a pixel's number is its ray's tag
static_assert(pixels <= 1 << CORE_TAG_BITS);

// The ray of `hitpipe render` through a pixel, in the mesh's own units.
struct Line {
  double origin[3];
  float direction[3];
};
Line camera_line(int pixel) {
  constexpr double eye[] = {0.5, 3.9, 9.4}, target[] = {0, 1.42, 0}, fov = 39 * 3.14159265358979 / 180;
  const double fx = target[0] - eye[0], fy = target[1] - eye[1], fz = target[2] - eye[2];  // forward
  const double flat = std::hypot(fx, fz), whole = std::hypot(flat, fy);
  const double side = 2 * std::tan(fov / 2) / height * whole;
  const double x = (pixel % width + 0.5 - width / 2.0) * side,
               y = (height / 2.0 - pixel / width - 0.5) * side;
  const double dx = fx - x * fz / flat - y * fx * fy / flat / whole, dy = fy + y * flat / whole;
  const double dz = fz + x * fx / flat - y * fz * fy / flat / whole, length = std::hypot(dx, dy, dz);
  return {
      {eye[0], eye[1], eye[2]},
      {static_cast<float>(dx / length), static_cast<float>(dy / length), static_cast<float>(dz / length)}};
}

int main(int count, char** arguments) {
  if (count != 3) return std::fprintf(stderr, "core_system scene.bin picture.pgm\n"), 2;

  std::ifstream file(arguments[1], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  core_image image;
  const char* refused = core_read_image(&image, reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  if (!refused) refused = core_start(place_image(arguments[1]), &image);
  if (refused) return std::fprintf(stderr, "%s: %s\n", arguments[1], refused), 1;

  std::vector<uint8_t> picture(pixels), answers(pixels);
  uint64_t failed = 0, hits = 0;
  int sent = 0, taken = 0;
  for (int silent = 0; taken < pixels && silent < 100'000; ++silent) {
    if (sent < pixels) {
      const Line line = camera_line(sent);
      core_ray ray;
      core_make_mesh_ray(&ray, &image, line.origin, line.direction, INFINITY);
      if (core_send(static_cast<uint32_t>(sent), &ray)) ++sent;
    }
    uint32_t pixel;
    core_hit hit;
    while (core_take(&pixel, &hit)) {
      silent = 0, ++taken, ++answers.at(pixel);
      if (hit.failed && failed++ == 0) std::fprintf(stderr, "pixel %u: %s\n", pixel, core_why(&hit));
      if (hit.failed || hit.number == CORE_NO_HIT) continue;
      ++hits;
      const double distance =
          core_mesh_distance(&hit, &image, camera_line(static_cast<int>(pixel)).direction);
      picture[pixel] =
          static_cast<uint8_t>(std::min(255.0, 10'000 / distance / distance));  // a lamp at the eye
    }
  }

  std::ofstream(arguments[2], std::ios::binary) << "P5 " << width << " " << height << " 255\n"
                                                << std::string(picture.begin(), picture.end());
  const uint64_t rays = core_count(CORE_COUNT_RAYS), answered = core_count(CORE_COUNT_ANSWERS);
  std::printf("%" PRIu64 " rays, %" PRIu64 " answers, %" PRIu64 " hits, %" PRIu64 " failed\n", rays, answered,
              core_count(CORE_COUNT_HITS), failed);
  std::printf("%" PRIu64 " cycles, %" PRIu64 " blocks read\n", core_count(CORE_COUNT_CYCLES),
              core_count(CORE_COUNT_RECORDS) + core_count(CORE_COUNT_TRIANGLES));
  // Every ray has one answer, and the core has counted what came.
  const bool once = std::all_of(answers.begin(), answers.end(), [](uint8_t n) { return n == 1; });
  return once && rays == pixels && answered == pixels && core_count(CORE_COUNT_HITS) == hits && failed == 0
             ? 0
             : 1;
}
