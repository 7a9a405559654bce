// A fit from end to end: what the scene asks for, the smallest unit for it, its files, and the proof that the
// unit misses nothing: random vectors and the image itself go through its Verilog.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "host/files.hpp"
#include "sim/cosim.hpp"
#include "sim/fit/fit.hpp"
#include "sim/fit/vector_check.hpp"

namespace hitpipe::sim {

struct FitOptions {
  int width = 256;
  int height = 256;
  int threads = 1;
  ref::WhittedOptions light{};  ///< how far secondary rays are followed
  double overhead_pct = 2.0;    ///< most extra box tests that fewer bits, or rays without ends, may cost
  bool keep_bits = false;       ///< the format stays as it is
  std::uint64_t vectors = 1'000'000;
  std::filesystem::path
      folder;  ///< each design's files go to a folder of its name in this one; empty: nowhere
  /// Told which step is under way and its finished share, 0..1. The first time of each step comes from the
  /// calling thread, further ones from any.
  std::function<void(const std::string& step, double share)> progress = [](const std::string&, double) {};
};

/// Made once for all designs.
struct FitScene {
  ref::Scene scene;
  ref::Bvh bvh;
  ref::SceneDemands demands;
  SceneRays rays;
};

/// Why a design cannot be fitted, one line; empty when it can.
[[nodiscard]] std::string why_not_fitted(const rtl::Design& design);
/// The format before the fit unless the user says otherwise.
[[nodiscard]] rtl::Format fit_from(const rtl::Design& design);

/// Builds the hierarchy and traces the rays of the image. Throws std::runtime_error, one line, when no ray
/// meets a triangle.
[[nodiscard]] FitScene prepare_fit(ref::Scene scene, const FitOptions& options);

struct FitResult {
  FittedUnit unit;  ///< what is left out: largest first
  VectorResult vectors;
  CosimResult image;  ///< a conservative design is judged by the referee

  [[nodiscard]] bool verified() const;
};

/// Throws as fewest_bits(), fit(), VerilatedDesign, host::write_files() and cosimulate() do.
[[nodiscard]] FitResult fit_to_scene(const rtl::Design& design, const rtl::Format& before,
                                     const FitScene& scene, const FitOptions& options,
                                     const rtl::Library& library);

}  // namespace hitpipe::sim
