// Uses the core on a board: writes an image to its memory, sends rays, and takes hits (docs/chips.md). What
// is lost on the line is sent again.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/serial_port.hpp"
#include "rays/image/core_image.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/board/frame_link.hpp"
#include "sim/core/core_bench.hpp"

namespace hitpipe::sim {

class CoreLink {
 public:
  using Patience = FrameLink::Patience;
  /// The share that is done, 0 to 1.
  using Progress = std::function<void(double)>;

  /// Port and core must outlive this.
  CoreLink(host::SerialPort& port, const rtl::Core& core, const Patience& patience = {});

  /// Throws std::runtime_error, one line, when nothing answers, or the board has another core.
  void require_same_core();
  /// No ray is in flight. Throws std::runtime_error, one line, when the image does not fit, and
  /// WrongHardware, one line, when the board does not answer any more.
  FrameLink::Counts write(const ref::CoreImage& image, const Progress& progress = {});
  /// Answers the jobs, each at its place. Throws WrongHardware, one line, when the board does not answer any
  /// more.
  FrameLink::Counts run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
                        const Progress& progress = {});

 private:
  const rtl::Core& core_;
  FrameLink link_;
};

/// Throws std::runtime_error, one line, when the memory of the board's chip has too few blocks for the image,
/// or the core too few levels.
void check_fits(const rtl::Core& core, const ref::CoreImage& image);

}  // namespace hitpipe::sim
