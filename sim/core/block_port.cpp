#include "sim/core/block_port.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "sim/core/line_bus.hpp"

namespace hitpipe::sim {

namespace {

using rtl::Word;
using namespace hls::channels;

class PlainPort final : public BlockPort {
 public:
  PlainPort(CorePins& pins, const ref::CoreImage& image, const MemoryOptions& memory)
      : BlockPort(pins, image, memory) {}

  Request request() override {
    const bool ready = memory_.ready();
    pins_.in(request_ready) = ready ? 1 : 0;
    const bool asked = pins_.out(request_valid) != 0;
    if (asked && ready) ask_memory();
    const Word kind = pins_.out(request_id) >> pins_.core.options.ray_bits();
    return {asked, asked && ready, kind != 0};
  }
  void show() override {
    pins_.in(read_valid) = block_ ? 1 : 0;
    if (!block_) {
      if (pins_.options.unruly) pins_.put_random(pins_.at[read_id], 1 + BlockWords::count);
      return;
    }
    pins_.in(read_id) = block_->tag;
    pins_.in(read_word_0) = block_->block[0];
    pins_.in(read_word_1) = block_->block[1];
    pins_.in(read_word_2) = block_->block[2];
    pins_.in(read_word_3) = block_->block[3];
    pins_.in(read_error) = block_->error ? 1 : 0;
  }
  bool end() override {
    block_ = memory_.step();
    return block_.has_value();
  }

 private:
  std::optional<MemoryAnswer> block_;
};

class CachePort final : public BlockPort {
 public:
  CachePort(CorePins& pins, const ref::CoreImage& image, const MemoryOptions& memory)
      : BlockPort(pins, image, memory),
        bus_(image.blocks, pins.core.bus, pins.options.unruly, pins.options.seed) {
    pins_.in(most_lines) = static_cast<Word>(pins_.options.most_lines);
    pins_.in(lets_asks) = 1;
  }

  /// The cache is emptied, reads few lines or many, and rays ask for nothing for a while.
  void change_settings() override {
    ref::adversary::Random& random = pins_.random;
    pins_.in(empties_cache) = random.below(pins_.in(empties_cache) != 0 ? 4 : 400) == 0 ? 1 : 0;
    if (random.below(100) == 0) pins_.in(most_lines) = Word{1} << random.below(line_count_bits);
    if (random.below(pins_.in(lets_asks) == 0 ? 20 : 500) == 0) pins_.in(lets_asks) ^= 1;
  }
  Request request() override {
    const bool ready = memory_.ready();
    pins_.in(request_ready) = ready ? 1 : 0;
    if (ready && pins_.out(request_valid) != 0) ask_memory();
    hits += pins_.out(cache_hit) != 0 ? 1 : 0;
    joins += pins_.out(cache_join) != 0 ? 1 : 0;
    const bool asked = pins_.out(asks) != 0;
    return {asked, asked && pins_.out(granted) != 0, pins_.out(asks_triangle) != 0};
  }
  void show() override {
    const std::optional<BusBeat> beat = bus_.beat();
    pins_.in(beat_valid) = beat ? 1 : 0;
    const auto lanes = static_cast<std::size_t>(pins_.core.options.data_bits) / 64;
    const bool has_id = pins_.at.has(hls::cache::beat_id);
    if (!beat) {
      if (!pins_.options.unruly) return;
      pins_.put_random(pins_.at[beat_error], 1 + lanes);
      if (has_id) pins_.put_random(pins_.at[hls::cache::beat_id], 1);
      return;
    }
    if (has_id) pins_.in(hls::cache::beat_id) = beat->id;
    pins_.in(beat_error) = beat->error ? 1 : 0;
    pins_.put(pins_.at[beat_0],
              {beat->words.begin(), beat->words.begin() + static_cast<std::ptrdiff_t>(lanes)});
  }
  bool end() override {
    const bool came = pins_.out(read_valid) != 0;
    bus_.step(pins_.in(beat_valid) != 0 && pins_.out(beat_ready) != 0);
    if (const std::optional<MemoryAnswer> line = memory_.step()) bus_.take(*line);
    return came;
  }

 private:
  LineBus bus_;
};

}  // namespace

void BlockPort::ask_memory() {
  const auto block = static_cast<std::uint64_t>(pins_.out(request_address) / ref::core_block_bytes);
  // Addresses go round at their last bit.
  const auto mask = static_cast<std::uint64_t>(rtl::ones_below(pins_.core.options.byte_bits - 5));
  memory_.ask(static_cast<std::uint32_t>((block - 2 * pins_.options.base) & mask),
              static_cast<std::uint32_t>(pins_.out(request_id)));
}

std::unique_ptr<BlockPort> make_block_port(CorePins& pins, const ref::CoreImage& image,
                                           const MemoryOptions& memory) {
  if (pins.core.bus.has_lines) return std::make_unique<CachePort>(pins, image, memory);
  return std::make_unique<PlainPort>(pins, image, memory);
}

}  // namespace hitpipe::sim
