// A small system around a core as a C++ program for Verilator: a memory, and a host that loads an image,
// sends rays and compares answers. It is the pattern for a system of one's own.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host/files.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/graph/word.hpp"

namespace hitpipe::rtl {

/// What the program loads: the blocks of an image, and rays with their answers.
struct CoreScene {
  struct Ray {
    std::vector<Word> fields;  ///< in the order of records_of().ray.ports
    /// Of the nearest triangle, or the next one that is crossed; without one all ones, and the ray's length. Of count
    /// the answer.
    std::uint64_t number, t;
    /// The halves of |det|, |u| and |v|, the high half first, if the core gives weights. They mean nothing without a
    /// hit.
    std::vector<std::uint64_t> weights{};
    std::uint64_t records = 0, triangles = 0;  ///< blocks that the ray reads
  };
  std::vector<std::array<std::uint64_t, 4>> blocks;
  std::vector<Ray> rays;
};

/// The folder tb/MODULE_axi_harness: the files of rtl_gen/core/harness, which are the same for every core, and
/// core.hpp and features.hpp, by which they know the core. The main function is in harness.cpp.
[[nodiscard]] std::vector<host::File> system_program(const Core& core);
/// tb/MODULE_scene.txt
[[nodiscard]] std::string scene_text(const Core& core, const CoreScene& scene);

}  // namespace hitpipe::rtl
