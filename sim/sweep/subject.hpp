// What decides the counts of a row, apart from the row's own unit: rows of one file have the same.
#pragma once

#include <cstdint>
#include <string>

namespace hitpipe::sim {

/// Of a list of rays `content` has the hash of the rays too. It makes no picture, so width, height and what
/// follows for light are 0.
struct SweepSubject {
  std::string program;  ///< the caller's name and version
  std::string scene;
  std::string content;  ///< a hash of mesh, materials, lights, camera and hierarchy
  std::uint64_t triangles = 0;
  std::string hierarchy;  ///< how it was made: ref::HierarchyOptions::name()
  std::uint64_t bvh_nodes = 0;
  int width = 0;
  int height = 0;
  int bounces = 0;
  int diffuse = 0;
  int occlusion = 0;
  std::uint64_t light_seed = 0;  ///< 0 where nothing is drawn by it
  std::string library;           ///< of components
  std::string cost;              ///< what the whole cost counts: "tests and set-up" or "tests"

  /// All of it in one line, for messages.
  [[nodiscard]] std::string text() const;

  friend bool operator==(const SweepSubject&, const SweepSubject&) = default;
};

}  // namespace hitpipe::sim
