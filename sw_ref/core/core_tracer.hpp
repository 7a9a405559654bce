// The core's walk in software: rays through an image, with a short stack and a restart trail, in exact
// integers. It says what the core must answer and how many blocks it reads. Its counts of nodes and triangles
// that are loaded are blocks; every restart reads the root's own record again. It tells an observer of
// loads about every block as a node, by its place in the image.
#pragma once

#include <atomic>
#include <cstdint>

#include "hls/box/major_format.hpp"
#include "hls/world/world_format.hpp"
#include "rays/image/core_image.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/trace/tracer.hpp"

namespace hitpipe::ref {

struct CoreTracerOptions {
  hls::WorldBits world{};
  hls::MajorBits boxes{20, 1, 11, 0, 20};  ///< in a format with S, of the same world
  int places = 8;                          ///< of the stack, 0 or more
};

class CoreTracer final : public Tracer {
 public:
  /// `image` is of `mesh`, an IntMesh's, whose triangles the answers name; both must outlive it. Throws
  /// std::invalid_argument, one line, for formats that do not go together.
  CoreTracer(const CoreImage& image, const Mesh& mesh, const CoreTracerOptions& options);

  void trace(const TraceJob& job, TraceCounts& counts) const override;
  [[nodiscard]] std::size_t bytes_per_node() const override { return core_block_bytes; }
  [[nodiscard]] std::size_t node_count() const override { return image_.blocks.size(); }
  /// Of all rays so far.
  [[nodiscard]] std::uint64_t restarts() const { return restarts_; }

 private:
  const CoreImage& image_;
  TriangleNumbers numbers_;
  CoreTracerOptions options_;
  mutable std::atomic<std::uint64_t> restarts_{0};
};

}  // namespace hitpipe::ref
