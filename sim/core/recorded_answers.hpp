// Answers in a file, one for each ray of a list: those of `core trace --answers`, or that somebody else recorded.
//
// CSV (number_file.hpp) with the columns
//   hit     1 or 0; empty where there is no answer
//   number  of the triangle, in the source of the mesh
//   t       T of the integer world; empty where it was not recorded
// and if somebody wants them
//   ray     its place in the list, from 0. So answers may have any order. Without the column it is that of the list
//   query   `nearest` or `any`, which must be what the ray asks
//   failed  0, or why there is no answer: hls::Failure
//   rays_in_flight  which of several cores has answered. Each answers all rays
// Other columns of `core trace --answers` may be there and are not read. Without a hit number and t are not read.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim/core/replay.hpp"
#include "sim/operands/ray_list.hpp"

namespace hitpipe::sim {

struct AnswerOfRay {
  std::size_t ray = 0;  ///< its place in the list
  RecordedAnswer answer;
};

/// In the order of the file. Throws std::runtime_error, one line that names the file and the line, for a file that
/// cannot be read or has another form, and when a ray has no answer, two of one core, or is none of the list.
/// `rays_file` is how messages call the list.
[[nodiscard]] std::vector<AnswerOfRay> read_recorded_answers(const std::string& file,
                                                             std::span<const AskedRay> rays,
                                                             const std::string& rays_file);

}  // namespace hitpipe::sim
