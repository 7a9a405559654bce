#include "sim/cosim/ray_source.hpp"

#include <algorithm>

namespace hitpipe::sim {

TileRays::TileRays(const Picture& picture, int left, int top)
    : picture_(picture),
      left_(static_cast<std::size_t>(left)),
      top_(static_cast<std::size_t>(top)),
      width_(static_cast<std::size_t>(std::min(side, picture.width - left))),
      light_(width_ * static_cast<std::size_t>(std::min(side, picture.height - top))) {}

std::uint32_t TileRays::number(std::size_t pixel) const {
  return static_cast<std::uint32_t>((top_ + pixel / width_) * static_cast<std::size_t>(picture_.width) +
                                    left_ + pixel % width_);
}

std::size_t TileRays::pixel(std::uint32_t number) const {
  const auto whole = static_cast<std::size_t>(picture_.width);
  return (number / whole - top_) * width_ + number % whole - left_;
}

std::optional<ref::RayTask> TileRays::next() {
  if (!waiting_.empty()) {
    const ref::RayTask task = waiting_.front();
    waiting_.pop_front();
    return task;
  }
  if (next_pixel_ == pixels()) return std::nullopt;
  const auto x = static_cast<int>(left_ + next_pixel_ % width_);
  const auto y = static_cast<int>(top_ + next_pixel_ / width_);
  return picture_.whitted->primary(x, y, picture_.width, picture_.height, number(next_pixel_++));
}

void TileRays::ended(const ref::RayTask& task, std::uint32_t triangle) {
  if (task.kind == ref::RayKind::primary) picture_.to.triangles[task.pixel] = triangle;
  caused_.clear();
  picture_.whitted->end(task, triangle, light_[pixel(task.pixel)], caused_);
  waiting_.insert(waiting_.end(), caused_.begin(), caused_.end());
}

void TileRays::draw() const {
  for (std::size_t i = 0; i < pixels(); ++i) picture_.to.image[number(i)] = light_[i].value();
}

ListRays::ListRays(std::span<const AskedRay> rays, std::size_t from, std::span<std::uint32_t> triangles)
    : rays_(rays.subspan(from, std::min(most, rays.size() - from))),
      triangles_(triangles.subspan(from, rays_.size())) {}

std::optional<ref::RayTask> ListRays::next() {
  if (next_ == rays_.size()) return std::nullopt;
  ref::RayTask task;
  task.ray = rays_[next_].ray;
  task.kind = rays_[next_].query == ref::Query::any ? ref::RayKind::shadow : ref::RayKind::primary;
  task.pixel = static_cast<std::uint32_t>(next_++);
  return task;
}

void ListRays::ended(const ref::RayTask& task, std::uint32_t triangle) {
  triangles_[task.pixel] = triangle;
}

}  // namespace hitpipe::sim
