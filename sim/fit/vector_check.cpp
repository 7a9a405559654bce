#include "sim/fit/vector_check.hpp"

#include <algorithm>

#include "rtl_gen/prune/draw.hpp"
#include "sim/unit/drive.hpp"

namespace hitpipe::sim {

VectorResult check_vectors(const VectorCheck& check) {
  constexpr std::uint64_t most_of_a_batch = 65'536;
  const Unit& unit = check.verilated->unit();
  const rtl::Evaluate evaluate = unit.design->evaluate(unit.format);
  rtl::DrawVectors draw(unit.ports(), unit.demands, evaluate, check.seed);
  Model model(*check.verilated);
  VectorResult result;
  while (result.vectors < check.vectors) {
    TestBatch batch;
    while (batch.size() < std::min(most_of_a_batch, check.vectors - result.vectors)) {
      const rtl::Vector vector = draw();
      result.hits += evaluate.hit(vector.results.data()) ? 1 : 0;
      batch.add(vector.operands, vector.results);
    }
    const DriveReport report = drive(model, batch,
                                     {.traffic = {.offered = 0.875, .taken = 0.875},
                                      .seed = check.seed + result.vectors,
                                      .first = result.vectors,
                                      .vector_seed = check.seed});
    result.vectors += batch.size();
    result.mismatches += report.faults();
    if (result.first_mismatch.empty()) result.first_mismatch = report.first_failure;
    // A unit that loses tests has more to answer for than can be told apart.
    if (report.lost > 0) break;
    check.progress(static_cast<double>(result.vectors) / static_cast<double>(check.vectors));
  }
  return result;
}

}  // namespace hitpipe::sim
