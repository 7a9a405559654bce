// The core's answers against the library's, for rays at a surface of one's own: compare. Ends with 1 if one differs.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <vector>

#include <hitpipe/scene.hpp>

#include "driver.h"

uint32_t place_image(const char* file_name);  // the system puts the file into memory, and says where
#if CORE_HAS_RINGS
#error "this program hands the core its rays one by one: configure without --rings"
#endif

constexpr int side = 60, rays_per_side = 40;

/// Hills of side x side squares of two triangles.
hitpipe::Scene hills() {
  std::vector<hitpipe::Point> corners;
  std::vector<hitpipe::TriangleCorners> triangles;
  for (unsigned y = 0; y <= side; ++y) {
    for (unsigned x = 0; x <= side; ++x) {
      const float u = static_cast<float>(x) / side, v = static_cast<float>(y) / side;
      corners.push_back({10 * u, 10 * v, std::sin(9 * u) * std::cos(7 * v)});
      if (x == side || y == side) continue;
      const unsigned at = y * (side + 1) + x;
      triangles.push_back({at, at + 1, at + side + 2});
      triangles.push_back({at, at + side + 2, at + side + 1});
    }
  }
  return {corners, triangles, {.world = "16+1s16"}};
}

int main() try {
  const hitpipe::Scene scene = hills();
  const std::vector<uint8_t> bytes = scene.core_image();
  std::ofstream("hills.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::vector<hitpipe::Ray> rays;
  for (int y = 0; y < rays_per_side; ++y)
    for (int x = 0; x < rays_per_side; ++x)
      rays.push_back({{0.25F * static_cast<float>(x), 5, 4},
                      {0.02F * static_cast<float>(x), 0.2F * static_cast<float>(y - rays_per_side / 2), -1},
                      hitpipe::endless});
  const hitpipe::Nearest right = scene.nearest(rays, false);

  core_image image;
  const char* refused = core_read_image(&image, bytes.data(), bytes.size());
  if (!refused) refused = core_start(place_image("hills.bin"), &image);
  if (refused) return std::fprintf(stderr, "compare: %s\n", refused), 2;
  std::size_t sent = 0, taken = 0, hits = 0, different = 0;
  for (int silent = 0; taken < rays.size() && silent < 100'000; ++silent) {
    if (sent < rays.size()) {
      const auto& [o, direction, length] = rays[sent];
      const double origin[] = {o[0], o[1], o[2]};
      core_ray ray;
      core_make_mesh_ray(&ray, &image, origin, direction, length);
      if (core_send(static_cast<uint32_t>(sent), &ray)) ++sent;
    }
    uint32_t i;
    for (core_hit hit; core_take(&i, &hit); silent = 0) {
      ++taken;
      const bool is_hit = hit.number != CORE_NO_HIT;
      hits += is_hit;
      different += hit.failed || hit.number != right.triangle[i] ||
                   (is_hit && core_mesh_distance(&hit, &image, rays[i].direction) != right.t[i]);
    }
  }
  std::printf("%zu rays, %zu answers, %zu hits, %zu differ from the library's\n", sent, taken, hits,
              different);
  return taken == rays.size() && different == 0 ? 0 : 1;
} catch (const hitpipe::Error& error) {
  return std::fprintf(stderr, "compare: %s\n", error.what()), 2;
}
