// Where the rays of a co-simulation come from: a tile of a picture, or a part of a list. Each part is traced
// by a unit of its own.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/operands/ray_list.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::sim {

class RaySource {
 public:
  virtual ~RaySource() = default;
  /// The next ray to trace; nothing at the end, unless a ray that has not ended causes more.
  [[nodiscard]] virtual std::optional<ref::RayTask> next() = 0;
  virtual void ended(const ref::RayTask& task, std::uint32_t triangle) = 0;
};

/// Where the results of all parts are collected. Parts write to places of their own.
struct TracedPicture {
  std::span<glm::vec3> image;
  std::span<std::uint32_t> triangles;  ///< by pixel, or by ray of a list
};

/// A tile of a picture. Its primary rays come in rows. The rays that a ray causes follow as soon as it ends.
class TileRays final : public RaySource {
 public:
  static constexpr int side = 64;

  struct Picture {
    const ref::Whitted* whitted;
    int width, height;
    TracedPicture to;
  };

  TileRays(const Picture& picture, int left, int top);
  [[nodiscard]] std::optional<ref::RayTask> next() override;
  void ended(const ref::RayTask& task, std::uint32_t triangle) override;
  /// To be called when all rays have ended.
  void draw() const;

 private:
  [[nodiscard]] std::size_t pixels() const { return light_.size(); }
  /// The number in the picture of a pixel of the tile, and the other way round.
  [[nodiscard]] std::uint32_t number(std::size_t pixel) const;
  [[nodiscard]] std::size_t pixel(std::uint32_t number) const;

  Picture picture_;
  std::size_t left_, top_, width_;
  std::size_t next_pixel_ = 0;
  std::deque<ref::RayTask> waiting_;
  std::vector<ref::RayTask> caused_;
  std::vector<ref::LightSum> light_;  // by pixel of the tile
};

/// Rays `from` to `from` + `most` of a list. A ray for any hit is a shadow ray, others are primary rays.
class ListRays final : public RaySource {
 public:
  static constexpr std::size_t most = 4096;

  ListRays(std::span<const AskedRay> rays, std::size_t from, std::span<std::uint32_t> triangles);
  [[nodiscard]] std::optional<ref::RayTask> next() override;
  void ended(const ref::RayTask& task, std::uint32_t triangle) override;

 private:
  std::span<const AskedRay> rays_;
  std::span<std::uint32_t> triangles_;
  std::size_t next_ = 0;
};

}  // namespace hitpipe::sim
