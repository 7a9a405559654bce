// A picture by the core: core_system scene.bin picture.pgm [rays.csv answers.csv]. It shows the scene `spheres` of
// hitpipe, and records rays and answers for `hitpipe core replay`.
#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#define CORE_RECORDS
#include "driver.h"

uint32_t place_image(const char* file_name);  // the system puts the file into memory, and says where
#if CORE_HAS_RINGS
uint32_t place_rings(uint32_t bytes);  // so much memory behind the image
#endif

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
  if (count != 3 && count != 5)
    return std::fprintf(stderr, "core_system scene.bin picture.pgm [rays.csv answers.csv]\n"), 2;

  std::ifstream file(arguments[1], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  core_image image;
  const char* refused = core_read_image(&image, reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  const uint32_t place = place_image(arguments[1]);
#if CORE_HAS_RINGS
  constexpr uint32_t places = 32'768;
  const uint32_t answers_place = place_rings(places * (CORE_HIT_BYTES + CORE_RAY_BYTES));
  core_rings rings;
  if (!refused)
    refused = core_start_rings(&rings, answers_place + places * CORE_HIT_BYTES, answers_place, places);
#endif
  if (refused) return std::fprintf(stderr, "%s: %s\n", arguments[1], refused), 1;

  FILE* const rays_record = count == 5 ? std::fopen(arguments[3], "w") : nullptr;
  FILE* const answers_record = count == 5 ? std::fopen(arguments[4], "w") : nullptr;
  const bool records = rays_record && answers_record;
  if (count == 5 && !records) return std::fprintf(stderr, "core_system: cannot write the records\n"), 1;
  if (records) core_begin_records(rays_record, answers_record);
  for (int pixel = 0; records && pixel < pixels; ++pixel) {
    const Line line = camera_line(pixel);
    core_record_ray(rays_record, line.origin, line.direction, INFINITY, false);
  }

  std::vector<uint8_t> picture(pixels), answers(pixels);
  uint64_t failed = 0, hits = 0;
  int taken = 0;
  const auto ray_of = [&](int pixel) {
    const Line line = camera_line(pixel);
    core_ray ray;
    core_make_mesh_ray(&ray, &image, line.origin, line.direction, INFINITY);
    return ray;
  };
  const auto take = [&](uint32_t pixel, const core_hit& hit) {
    ++taken, ++answers.at(pixel);
    if (records) core_record_answer(answers_record, pixel, &hit);
    if (hit.failed && failed++ == 0) std::fprintf(stderr, "pixel %u: %s\n", pixel, core_why(&hit));
    if (hit.failed || hit.number == CORE_NO_HIT) return;
    ++hits;
    const double distance = core_mesh_distance(&hit, &image, camera_line(static_cast<int>(pixel)).direction);
    picture[pixel] =
        static_cast<uint8_t>(std::min(255.0, 10'000 / distance / distance));  // a lamp at the eye
  };
#if CORE_HAS_RINGS
  // All rays are in memory before the first begins.
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const core_ray ray = ray_of(pixel);
    core_send(&rings, static_cast<uint32_t>(pixel), &ray);
  }
  refused = core_start(place, &image);
  if (refused) return std::fprintf(stderr, "%s: %s\n", arguments[1], refused), 1;
  core_offer(&rings);
  for (int polls = 0; core_answers(&rings) < pixels && !rings.wrong && polls < 1'000'000;) ++polls;
  if (rings.wrong) std::fprintf(stderr, "answer %u: %s\n", rings.known, rings.wrong);
  const uint64_t cycles = core_count(CORE_COUNT_CYCLES);
  uint32_t pixel;
  for (core_hit hit; core_take(&rings, &pixel, &hit);) take(pixel, hit);
#else
  refused = core_start(place, &image);
  if (refused) return std::fprintf(stderr, "%s: %s\n", arguments[1], refused), 1;
  int sent = 0;
  for (int silent = 0; taken < pixels && silent < 100'000; ++silent) {
    if (sent < pixels) {
      const core_ray ray = ray_of(sent);
      if (core_send(static_cast<uint32_t>(sent), &ray)) ++sent;
    }
    uint32_t pixel;
    for (core_hit hit; core_take(&pixel, &hit); silent = 0) take(pixel, hit);
  }
  const uint64_t cycles = core_count(CORE_COUNT_CYCLES);
#endif

  if (records && (std::fclose(rays_record) | std::fclose(answers_record)) != 0)
    return std::fprintf(stderr, "core_system: cannot write the records\n"), 1;
  std::ofstream(arguments[2], std::ios::binary) << "P5 " << width << " " << height << " 255\n"
                                                << std::string(picture.begin(), picture.end());
  const uint64_t rays = core_count(CORE_COUNT_RAYS), answered = core_count(CORE_COUNT_ANSWERS);
  std::printf("%" PRIu64 " rays, %" PRIu64 " answers, %" PRIu64 " hits, %" PRIu64 " failed\n", rays, answered,
              core_count(CORE_COUNT_HITS), failed);
  std::printf("%" PRIu64 " cycles, %" PRIu64 " blocks read\n", cycles,
              core_count(CORE_COUNT_RECORDS) + core_count(CORE_COUNT_TRIANGLES));
  // Every ray has one answer, and the core has counted what came.
  const bool once = std::all_of(answers.begin(), answers.end(), [](uint8_t n) { return n == 1; });
  return once && rays == pixels && answered == pixels && core_count(CORE_COUNT_HITS) == hits && failed == 0
             ? 0
             : 1;
}
