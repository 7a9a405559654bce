// A core that has what some scenes need and no more (docs/fit.md, "Fitting a core"). Bits of coordinates are chosen by
// error against cost, widths by bounds of the scenes' images, the rest by measuring their rays.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "area_model/core_price.hpp"
#include "rays/scene/scene.hpp"
#include "rays/tree/load_bvh.hpp"
#include "rays/world/int_scene.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/core/memory_port.hpp"
#include "sim/core/picture_rays.hpp"
#include "sw_ref/judge/interval.hpp"

namespace hitpipe::sim {

/// What the smaller of two cores is.
enum class CoreGoal {
  area,  ///< that takes less, of those that reach the rate
  rate   ///< that traces more rays a second in a lookup table, or in mm2
};

/// Which options stay as they are.
struct CoreFixed {
  bool world = false;  ///< n, g, S and F
  bool boxes = false;  ///< p and B
  bool rays = false;   ///< in flight
  bool stack = false;
  bool triangles = false;  ///< their interval
  bool cache = false;
  bool levels = false, block_bits = false, byte_bits = false, tag_bits = false;
  bool number_bits = false, leaf_bits = false, step_bits = false;
};

/// The options of a core that a fit chooses unless they are given.
inline constexpr std::pair<std::string_view, bool CoreFixed::*> fitted_options[] = {
    {"--rays", &CoreFixed::rays},
    {"--stack", &CoreFixed::stack},
    {"--triangle-ii", &CoreFixed::triangles},
    {"--cache", &CoreFixed::cache},
    {"--levels", &CoreFixed::levels},
    {"--block-bits", &CoreFixed::block_bits},
    {"--address-bits", &CoreFixed::byte_bits},
    {"--tag-bits", &CoreFixed::tag_bits},
    {"--number-bits", &CoreFixed::number_bits},
    {"--leaf-bits", &CoreFixed::leaf_bits},
    {"--step-bits", &CoreFixed::step_bits}};

struct CoreFitOptions {
  rtl::CoreOptions core{};  ///< what is fixed has the values of these options
  CoreFixed fixed{};
  CoreGoal goal = CoreGoal::area;
  double rays_per_second = 0;  ///< that the core reaches in each scene; 0: any
  /// For the area: of the blocks that rays read, so many more because of coarse boxes and a short stack.
  double overhead_pct = 5;
  /// Of rays that may find another triangle than in the float world: the high end of Wilson's 95 % interval.
  double error_pct = 0.05;
  std::optional<std::int64_t> most_luts{};  ///< that the chip has
  MemoryPort memory{};
  std::vector<int> caches{0};  ///< KiB that are tried
  /// Of the pictures whose rays are traced. Those whose rays are compared have more pixels if `error_pct` needs them.
  int width = 64, height = 64;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  /// Gets what is done now.
  std::function<void(const std::string& step)> progress = [](const std::string&) {};
};

/// A scene in the format of the core, as memory holds it, and the rays of its picture.
struct CoreFitScene {
  std::shared_ptr<const ref::IntScene> scene;
  ref::CoreImage image;
  std::uint64_t most_steps = 0;  ///< records that one of its rays tests
  std::vector<CoreJob> jobs;
};

/// What was left out, and why. `before` is the fitted core without this cut.
struct CoreCut {
  std::string what, why;
  rtl::CoreOptions before;
  area::CorePartPrice without{};
};

/// How fast a core traces the rays of each scene.
struct CoreRate {
  std::vector<double> cycles_a_ray;
  int clock_ps = 0;
  /// In the slowest scene.
  [[nodiscard]] double rays_per_second() const;
};

/// A step of the search for bits.
struct TriedWorld {
  hls::WorldBits bits;
  std::vector<ref::Share> different;  ///< rays of each scene
  bool taken = false;
  /// The scene of the greatest high end.
  [[nodiscard]] const ref::Share& worst() const;
};

struct CoreFit {
  rtl::CoreOptions before;  ///< the options that it began with, with room for the scenes
  rtl::CoreOptions core;
  area::CorePrice price_before, price;
  CoreRate rate_before, rate;
  std::vector<TriedWorld> tried;
  std::vector<CoreCut> cuts;  ///< the largest first
  std::vector<CoreFitScene> scenes;
  int cores_tried = 0;

  /// The bits that the search took; null when they were fixed.
  [[nodiscard]] const TriedWorld* taken() const;
};

/// The part of a price that is compared: square micrometres, or lookup tables of a chip.
[[nodiscard]] std::int64_t size_of(const area::CorePartPrice& price, const rtl::Library& library);

/// Throws std::runtime_error, one line, when no bits keep to the error, no core reaches the rate or fits the chip, and
/// as make_core(), int_scene() and core_image() do.
[[nodiscard]] CoreFit fit_core(const std::vector<ref::Scene>& scenes, const CoreFitOptions& options,
                               const rtl::Library& library);

}  // namespace hitpipe::sim
