// Cores that trace one scene, each with its own number of rays in flight.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hls/world/ray_format.hpp"
#include "rays/image/core_image.hpp"
#include "rays/world/int_scene.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/memory_model.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/operands/ray_list.hpp"
#include "sw_ref/core/core_tracer.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::sim {

struct CoreSetOptions {
  rtl::CoreOptions core;  ///< of each; its format, and its numbers of rays and blocks, do not count
  hls::RayBits bits;      ///< of each
  std::vector<int> rays_in_flight;
  MemoryOptions memory;
  bool native = false;  ///< as C++, else as Verilog
};

class CoreSet {
 public:
  /// Scene and image must outlive it. Throws std::runtime_error, one line with the option, when the image has more of
  /// something than the cores have room for.
  CoreSet(std::shared_ptr<const ref::IntScene> scene, const ref::CoreImage& image, CoreSetOptions options);

  /// Makes the cores, and compiles them if they are Verilog.
  void make(const rtl::Library& library);
  [[nodiscard]] std::size_t size() const { return options_.rays_in_flight.size(); }

  /// The rays of a picture, with what software answers and reads for them.
  [[nodiscard]] PictureRays picture(const ref::RenderOptions& render) const {
    return picture_rays(scene_, image_, walking_, render);
  }
  /// The same of a list.
  [[nodiscard]] PictureRays listed(std::span<const AskedRay> rays) const {
    return listed_rays(scene_, image_, walking_, rays);
  }

  /// As trace_core() does, by one of the cores that were made.
  [[nodiscard]] CoreTrace trace(std::size_t core, const PictureRays& rays,
                                const std::function<void(double)>& progress,
                                const std::function<void(std::span<const CoreAnswer>)>& answered) const {
    return trace_core(cores_[core], *machines_[core], image_, rays, options_.memory, progress, answered);
  }
  [[nodiscard]] CoreTrace trace(std::size_t core, std::span<const ref::Ray> rays,
                                const QuestionOptions& questions) const {
    return trace_core(cores_[core], *machines_[core], image_, *scene_, rays, options_.memory, questions);
  }
  /// In the cores, or as a model.
  [[nodiscard]] bool has_cache() const {
    return options_.memory.reads_lines || options_.memory.cache_kib > 0;
  }

 private:
  std::shared_ptr<const ref::IntScene> scene_;
  const ref::CoreImage& image_;
  CoreSetOptions options_;
  ref::CoreTracerOptions walking_;
  std::vector<rtl::Core> cores_;
  std::vector<std::unique_ptr<rtl::NativeMachine>> machines_;
};

}  // namespace hitpipe::sim
