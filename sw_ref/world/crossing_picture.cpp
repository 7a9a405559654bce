#include "sw_ref/world/crossing_picture.hpp"

#include <algorithm>
#include <cstddef>

#include "host/parallel.hpp"
#include "rays/world/int_ray.hpp"
#include "sw_ref/render/camera.hpp"

namespace hitpipe::ref {

CrossingPicture crossing_picture(const IntScene& scene, const MeshCrossings& crossings, int width, int height,
                                 int threads, const std::function<void(double)>& progress) {
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  std::vector<CrossingCount> counts(columns * rows);
  host::for_each_index(
      rows, threads,
      [&](std::size_t y) {
        for (std::size_t x = 0; x < columns; ++x) {
          const Ray ray =
              primary_ray(scene.scene.camera, static_cast<int>(x), static_cast<int>(y), width, height);
          counts[y * columns + x] = crossings.count(int_ray(ray, scene.bits));
        }
      },
      progress);
  CrossingPicture made;
  for (const CrossingCount& count : counts) {
    made.counts.push_back(static_cast<float>(count.crossings));
    made.crossings += count.crossings;
    made.most = std::max(made.most, count.crossings);
    made.odd_rays += count.crossings % 2;
    made.ties += count.ties;
  }
  return made;
}

}  // namespace hitpipe::ref
