// What software knows of a design: the set-up that makes its operands of rays and boxes, the software
// traversal that answers as it does, what a scene tells of its operands, and in which formats it is studied.
// A design states its own in sim/designs/NAME.cpp. A part may be missing; what needs it then refuses the
// design, or leaves it out and says so.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/check/box_test.hpp"
#include "sim/feed.hpp"
#include "sw_ref/adversary/categories.hpp"
#include "sw_ref/demands/scene_demands.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/traverse/tracer.hpp"

namespace hitpipe::sim {

/// The numbers that a port can have for all rays and boxes of a scene.
struct ScenePromise {
  rtl::Interval range;
  int spare_bits = 0;  ///< of the port's width, which no scene uses
};

struct Software {
  std::unique_ptr<SceneFeed> (*feed)(const rtl::Format& format, const ref::Bvh& bvh) = nullptr;
  std::unique_ptr<BoxTest> (*box_test)(const rtl::Design& design, const rtl::Format& format) = nullptr;
  /// The software traversal whose box tests answer as the unit does.
  ref::TracerOptions (*traversal)(const rtl::Format& format) = nullptr;
  std::size_t (*bytes_per_node)(const rtl::Format& format, const ref::CoarseAxes& coarse) = nullptr;

  /// Nothing when the scene says no more than the port's own range.
  std::optional<ScenePromise> (*promise)(const rtl::Port& port, const rtl::Format& format,
                                         const ref::SceneDemands& scene,
                                         const ref::CoarseAxes& coarse) = nullptr;
  /// The scene's origins and boxes stay on the grid with coarser axes. Null: the design has no such axes.
  bool (*fits_coarse)(const rtl::Format& format, const ref::SceneDemands& scene,
                      const ref::CoarseAxes& coarse) = nullptr;
  /// Formats that need no more of anything than `most`, in groups of growing cost, each group in order of
  /// growing cost; the last of the last is `most`. Null: there is no format to choose.
  std::vector<std::vector<rtl::Format>> (*up_to)(const rtl::Format& most) = nullptr;

  std::vector<rtl::Format> sweep_formats{};
  std::vector<rtl::Format> stiffness_formats{};
  std::optional<rtl::Format> fit_from{};  ///< the format before a fit
  /// Categories of rays and boxes that are made for this design, beside the adversary's own.
  std::vector<ref::adversary::Category> categories{};
  /// A box test that `check` judges beside the design's.
  MakeBoxTest beside{};
};

/// Of a design that states nothing, all parts are missing.
[[nodiscard]] const Software& software_of(const rtl::Design& design);
/// For a program with designs of its own, before it uses any.
void add_software(std::string_view design, Software software);

/// The formats in which `stiffness` studies a design unless told otherwise; its default if it states none.
[[nodiscard]] std::vector<rtl::Format> stiffness_formats(const rtl::Design& design);

/// "design x: there is no set-up of rays and boxes", for a part that is missing.
[[nodiscard]] std::string missing(const rtl::Design& design, std::string_view part);
inline constexpr std::string_view set_up_part = "set-up of rays and boxes for its operands";
inline constexpr std::string_view traversal_part = "software traversal that answers as it does";
inline constexpr std::string_view promise_part = "rule for what a scene tells of its operands";

/// Why the design cannot trace a scene, one line; empty when it can.
[[nodiscard]] std::string why_not_traced(const rtl::Design& design);

}  // namespace hitpipe::sim
