// A fit from end to end: what the scene needs, the smallest unit for it, its files, and a check of the unit.
// The check sends random vectors and the image itself through the unit's Verilog.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "host/files.hpp"
#include "rays/tree/load_bvh.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/fit/fit.hpp"
#include "sim/unit/drive.hpp"

namespace hitpipe::sim {

/// A unit of a design that is cut to a scene, and the tests that it makes on the scene's rays.
struct PricedTests {
  const rtl::Design* design;
  Format format;
  area::Price price;
  ref::TraceCounts tests;
};

struct FitOptions {
  int width = 256;
  int height = 256;
  int threads = 1;
  ref::WhittedOptions light{};  ///< how far secondary rays are followed
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  double overhead_pct = 2.0;  ///< limit of the extra box tests from fewer bits and from rays without ends
  /// If there is one, the precision with the least cost is taken, and the limit only says where the search
  /// begins. With a rate the least area among units that reach it is taken instead. The limit then holds if
  /// there is no cost, or if the rate is one of boxes.
  std::function<double(const PricedTests&)> cost{};
  bool keep_bits = false;  ///< the format stays as it is
  FitRate rate{};
  /// If positive, of which `rate` is: so many of the scene's rays are to be traced in a second.
  double rays_per_second = 0;
  std::uint64_t vectors = 1'000'000;
  /// Each design's files go to a subfolder with its name. Empty: no files are written.
  std::filesystem::path folder;
  /// Gets the current step and its finished share, 0..1. The calling thread makes the first call of each
  /// step; any thread makes the others.
  std::function<void(const std::string& step, double share)> progress = [](const std::string&, double) {};
};

/// What all designs of a fit share.
struct FitScene {
  ref::Scene scene;
  ref::Bvh bvh;
  ref::SceneDemands demands;
  ref::Recording rays;  ///< by a traversal without extra tests
};

/// Why a design cannot be fitted, one line; empty when it can.
[[nodiscard]] std::string why_not_fitted(const rtl::Design& design);
/// The format before the fit unless the user says otherwise.
[[nodiscard]] Format fit_from(const rtl::Design& design);

/// Builds the hierarchy and traces the rays of the image. Throws std::runtime_error, one line, when no ray
/// meets a triangle.
[[nodiscard]] FitScene prepare_fit(ref::Scene scene, const FitOptions& options);

struct FitResult {
  FittedUnit unit;  ///< what is left out is sorted by area, largest first
  VectorResult vectors;
  CosimResult image;           ///< the referee judges it if the design is conservative
  double rays_per_second = 0;  ///< of the image, at the schedule's clock
  bool drawn = true;           ///< false: the schematics are not drawn, because Graphviz is not installed

  [[nodiscard]] bool verified() const;
};

/// Throws what fewest_bits(), fit(), VerilatedDesign, rtl::write_unit() and cosimulate() throw.
[[nodiscard]] FitResult fit_to_scene(const rtl::Design& design, const Format& before, const FitScene& scene,
                                     const FitOptions& options, const rtl::Library& library);

}  // namespace hitpipe::sim
