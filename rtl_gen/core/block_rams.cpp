#include "rtl_gen/core/block_rams.hpp"

#include <algorithm>
#include <vector>

namespace hitpipe::rtl {

namespace {

constexpr int block_ram_width = 16;

struct Candidate {
  std::string_view part;
  const hls::MemoryShape* memory;

  [[nodiscard]] int blocks() const { return (memory->width + block_ram_width - 1) / block_ram_width; }
  [[nodiscard]] double bits_a_block() const {
    return static_cast<double>(memory->words) * memory->width / blocks();
  }
};

}  // namespace

std::map<std::string_view, std::set<std::string>> in_block_rams(const Core& core, int most) {
  std::vector<Candidate> candidates;
  for (const Part& part : core.parts) {
    if (!part.graph) continue;
    for (const hls::MemoryShape& memory : part.graph->memories)
      if (memory.is_late()) candidates.push_back({part.name, &memory});
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.bits_a_block() > b.bits_a_block();
  });
  std::map<std::string_view, std::set<std::string>> chosen;
  for (const Candidate& candidate : candidates) {
    if (candidate.blocks() > most) continue;
    most -= candidate.blocks();
    chosen[candidate.part].insert(candidate.memory->name);
  }
  return chosen;
}

}  // namespace hitpipe::rtl
