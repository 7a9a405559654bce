// What software knows of a design: the set-up that makes its operands from rays and boxes, the software
// traversal that gives the same answers, what a scene tells about its operands, and the formats in which it
// is studied. A design states these in sim/designs/NAME.cpp. A part may be missing. A command that needs the
// part then refuses the design, or leaves it out and says so.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "area_model/set_up.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/software/box_software.hpp"
#include "sim/software/feed.hpp"
#include "sim/software/triangle_software.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/quantise/scene_demands.hpp"

namespace hitpipe::sim {

/// The numbers that a port can have over all rays and boxes of a scene.
struct SceneDemand {
  std::vector<rtl::Interval> within;  ///< ascending, as in a PortDemand
  int spare_bits = 0;                 ///< bits of the port that no scene uses
};

/// A unit that software traces for.
struct TracedUnit {
  Format format;
  ref::CoarseAxes coarse{};
  bool ends = true;  ///< false: box tests do not know where rays end
};

/// A hierarchy as a unit reads it: records of the same size, one after the other.
struct NodeRecords {
  std::size_t bytes_per_record = 0;
  std::vector<std::byte> bytes;
};

struct Software {
  std::unique_ptr<SceneFeed> (*feed)(const Format& format, const ref::Bvh& bvh) = nullptr;
  std::unique_ptr<BoxTest> (*box_test)(const rtl::Design& design, const Format& format) = nullptr;
  /// Of a triangle unit, which has neither feed nor box_test.
  std::unique_ptr<TriangleTest> (*triangle_test)(const rtl::Design& design, const Format& format) = nullptr;
  /// A tracer whose box tests answer as the unit does, and which is faster than the generic tracer
  /// (sim/cosim/generic_tracer.hpp). It outlives neither mesh nor hierarchy.
  std::unique_ptr<ref::Tracer> (*tracer)(const TracedUnit& unit, const ref::Mesh& mesh,
                                         const ref::Bvh& bvh) = nullptr;
  /// The tracer of ref::make_tracer() with the same answers, so that the program can name it. Null: there is
  /// none.
  ref::TracerOptions (*named_tracer)(const Format& format) = nullptr;
  /// Null: six planes as wide as their ports, then count and pointer of 4 bytes each.
  std::size_t (*bytes_per_node)(const Format& format, const ref::CoarseAxes& coarse) = nullptr;

  /// The divisions of a ray's set-up. Null: the design does not say.
  area::Divisions (*divisions)(const Format& format) = nullptr;

  /// Null: the unit reads nodes, not records of its own.
  NodeRecords (*records)(const Format& format, const ref::Bvh& bvh) = nullptr;

  /// Nothing when the scene tells no more than the port's own range.
  std::optional<SceneDemand> (*demand)(const rtl::Port& port, const Format& format,
                                       const ref::SceneDemands& scene,
                                       const ref::CoarseAxes& coarse) = nullptr;
  /// True when the scene's origins and boxes stay on the grid with these coarser axes. Null: no such axes.
  bool (*fits_coarse)(const Format& format, const ref::SceneDemands& scene,
                      const ref::CoarseAxes& coarse) = nullptr;
  /// Formats that a fit may choose instead of `most`: none needs more of anything. They come in groups of
  /// growing cost, and in each group the cost grows too. The last format of the last group is `most`. Null:
  /// there is no format to choose.
  std::vector<std::vector<Format>> (*smaller_formats)(const Format& most) = nullptr;

  std::vector<Format> sweep_formats{};
  std::vector<Format> stiffness_formats{};
  std::optional<Format> fit_from{};  ///< the format that a fit starts from
  /// Categories of rays and boxes made for this design, in addition to the adversary's own.
  std::vector<ref::adversary::Category> categories{};
  /// A second box test that `check` judges for comparison.
  MakeBoxTest comparison_test{};
};

using SoftwareByName = std::map<std::string, Software, std::less<>>;

/// The software of the designs in designs.cmake. The build writes this function.
[[nodiscard]] SoftwareByName own_software();
/// All parts are missing for a design that states nothing.
[[nodiscard]] const Software& software_of(const rtl::Design& design);
/// For a program that has designs of its own, before it uses any: adds the design and its software. Throws
/// std::invalid_argument, one line, for a name that is taken, and then adds neither.
void add_design(const rtl::Design& design, Software software);
/// The software of a design that is added already, or of one that is in no list.
void add_software(std::string_view design, Software software);

/// The formats in which `check --stiff` studies a design without --bits. The default format if the design
/// states none.
[[nodiscard]] std::vector<Format> stiffness_formats(const rtl::Design& design);

/// The line that names a missing part: "design x: there is no set-up of rays and boxes for its operands".
[[nodiscard]] std::string missing(const rtl::Design& design, std::string_view part);
inline constexpr std::string_view set_up_part = "set-up of rays and boxes for its operands";
inline constexpr std::string_view triangle_part = "set-up of rays and triangles for its operands";
inline constexpr std::string_view demand_part = "rule for what a scene tells of its operands";

/// Why the design cannot trace a scene, one line; empty when it can.
[[nodiscard]] std::string why_not_traced(const rtl::Design& design);

}  // namespace hitpipe::sim
