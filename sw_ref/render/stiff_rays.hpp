// How many rays of an image are stiff: the components of their directions differ by orders of magnitude. Such
// rays are hard for units whose three IRDVCs share one scale (section 6.2.1).
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// A ray is stiff when its smallest component has less than 2^-10 of the magnitude of its largest one. An
/// n/t unit then keeps at most n - 11 bits of its smallest IRDVC: 5 at 16/16.
inline constexpr float stiff_ratio = 0x1p-10F;

[[nodiscard]] bool is_stiff(const Ray& ray);
/// Some component is exactly zero.
[[nodiscard]] bool has_zero_component(const Ray& ray);

/// Adds up the rays of an image, from any thread.
class StiffRays {
 public:
  void add(std::span<const Ray> rays);

  [[nodiscard]] double stiff_pct() const { return percent(stiff_); }
  /// Of those with a component that is exactly zero; they are stiff too.
  [[nodiscard]] double zero_component_pct() const { return percent(zero_); }

 private:
  /// 0 without rays.
  [[nodiscard]] double percent(std::uint64_t part) const {
    return rays_ == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(rays_);
  }

  std::atomic<std::uint64_t> rays_ = 0;
  std::atomic<std::uint64_t> stiff_ = 0;
  std::atomic<std::uint64_t> zero_ = 0;
};

}  // namespace hitpipe::ref
