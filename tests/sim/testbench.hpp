// Vectors through a Verilated design, as the tests send them.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/unit/drive.hpp"

namespace hitpipe::sim {

/// Compared with the C++ datapath. Every bit of the tag changes often.
[[nodiscard]] inline DriveReport drive_all(Model& model,
                                           const std::vector<std::vector<std::int64_t>>& vectors,
                                           const Traffic& traffic, std::uint64_t seed,
                                           std::uint64_t vector_seed) {
  const rtl::Unit& unit = model.design().unit();
  return drive(model, TestBatch(vectors, unit.design->evaluate(unit.format)),
               {.traffic = traffic, .seed = seed, .tag_step = 40'503, .vector_seed = vector_seed});
}

}  // namespace hitpipe::sim
