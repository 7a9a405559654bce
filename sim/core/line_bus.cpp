#include "sim/core/line_bus.hpp"

namespace hitpipe::sim {

LineBus::LineBus(std::span<const ref::CoreBlock> blocks, const rtl::CoreBus& bus, bool mingles,
                 std::uint64_t seed)
    : blocks_(blocks), bus_(bus), mingles_(mingles), random_(seed) {}

void LineBus::take(const MemoryAnswer& line) {
  lines_.push_back(
      {.answer = line, .bad = static_cast<int>(random_.below(static_cast<std::size_t>(bus_.beats())))});
  if (!shown_) choose();
}

std::optional<BusBeat> LineBus::beat() const {
  if (!shown_) return std::nullopt;
  const Line& line = lines_[*shown_];
  const MemoryAnswer& answer = line.answer;
  BusBeat beat{.id = answer.tag, .error = answer.error && line.beats == line.bad};
  const auto words = static_cast<std::size_t>(bus_.data_bits) / 64;
  const std::size_t line_words = static_cast<std::size_t>(bus_.burst_bits) / 64;
  constexpr std::size_t block_words = std::tuple_size_v<ref::CoreBlock>;
  for (std::size_t word = 0; word < line_words; ++word) {
    // A beat that is wider than the line has it where its address says.
    const std::size_t at = word + (line_words < words ? answer.number % 2 * block_words : 0);
    if (line_words >= words && word / words != static_cast<std::size_t>(line.beats)) continue;
    const std::size_t block = answer.number + word / block_words;
    beat.words[at % words] = word < block_words       ? answer.block[word]
                             : block < blocks_.size() ? blocks_[block][word % block_words]
                                                      : 0;
  }
  return beat;
}

void LineBus::step(bool taken) {
  if (taken) {
    Line& line = lines_[*shown_];
    if (++line.beats == bus_.beats()) lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(*shown_));
    shown_.reset();
  }
  if (!shown_) choose();
}

/// The beat of the next cycle.
void LineBus::choose() {
  if (lines_.empty() || (mingles_ && random_.below(4) == 0)) return;
  shown_ = mingles_ && !bus_.has_one_id ? random_.below(lines_.size()) : 0;
}

}  // namespace hitpipe::sim
