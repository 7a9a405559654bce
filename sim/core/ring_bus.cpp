#include "sim/core/ring_bus.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

namespace {

using rtl::Word;
using namespace hls::channels;
using namespace hls::rings;

constexpr std::size_t words_of_ray = 4, words_of_answer = 2;

}  // namespace

RingBus::RingBus(const rtl::Core& core, const RingBusOptions& options)
    : core_(core),
      options_(options),
      at_(core),
      random_(options.seed),
      beat_words_(at_.has(fetched_1) ? 2 : 1),
      rays_at_(random_.bits() & rtl::ones_below(core.options.byte_bits - 7)),
      answers_at_(random_.bits() & rtl::ones_below(core.options.byte_bits - 7)),
      rays_(std::min(most_places, std::uint64_t{1} << (core.options.byte_bits - 5))),
      answers_(rays_.size()) {}

std::uint64_t RingBus::latency() {
  const auto usual = static_cast<std::uint64_t>(options_.latency);
  return options_.unruly ? 1 + random_.below(2 * usual) : usual;
}

void RingBus::offer(std::span<const Word> fields, std::uint32_t tag) {
  const auto number = [&](std::size_t i) { return static_cast<std::uint64_t>(fields[i]); };
  const std::uint64_t high = tag | number(0) << 24;
  rays_[offered_++ % rays_.size()] = {number(1) | number(2) << 32, number(3) | number(4) << 32,
                                      number(5) | number(6) << 32, number(7) | high << 32};
  ++on_their_way_;
}

void RingBus::show(std::span<Word> inputs) {
  inputs[at_[rays_at]] = rays_at_;
  inputs[at_[answers_at]] = answers_at_;
  inputs[at_[ring_last]] = rays_.size() - 1;
  // Behind an answer that could not be written any number is offered.
  inputs[at_[rays_offered]] = (failed_ ? random_.bits() : offered_) & rtl::ones_below(ring_count_bits);
  inputs[at_[lets_fetches]] = one_in(8) ? 0 : 1;
  inputs[at_[lets_rings]] = one_in(16) ? 0 : 1;
  inputs[at_[fetch_ready]] = one_in(4) ? 0 : 1;
  inputs[at_[store_ready]] = one_in(4) ? 0 : 1;
  inputs[at_[put_ready]] = one_in(4) ? 0 : 1;
  const bool stored = stored_due_ && *stored_due_ <= cycle_;
  inputs[at_[stored_valid]] = stored ? 1 : 0;
  if (!stored && options_.unruly) inputs[at_[stored_error]] = random_.bits() & 1;
  failed_ |= stored && cycle_ > calm_cycles && one_in(4);
  if (stored) inputs[at_[stored_error]] = failed_ ? 1 : 0;
  shown_ = !reads_.empty() && reads_.front().due <= cycle_ && !one_in(4);
  inputs[at_[fetched_valid]] = shown_ ? 1 : 0;
  const auto words = std::span(inputs).subspan(at_[fetched_0], beat_words_);
  if (!shown_) {
    if (!options_.unruly) return;
    inputs[at_[fetched_error]] = random_.bits() & 1;
    for (Word& word : words) word = random_.bits();
    return;
  }
  const Read& read = reads_.front();
  inputs[at_[fetched_error]] = read.error ? 1 : 0;
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = rays_[(read.place + i) / words_of_ray % rays_.size()][(read.place + i) % words_of_ray];
}

void RingBus::step(std::span<const Word> inputs, std::span<const Word> outputs) {
  const auto is = [&](std::span<const Word> ports, auto field) { return ports[at_[field]] != 0; };
  const Word mask = rtl::ones_below(core_.options.byte_bits);
  // Addresses go round at their last bit.
  const auto place_of = [&](auto field, Word base, std::size_t words) {
    const auto byte = static_cast<std::uint64_t>((outputs[at_[field]] - (base << 7)) & mask);
    const std::uint64_t record = 8 * words;
    if (byte % record != 0 || byte >= rays_.size() * record)
      throw std::logic_error(
          fmt::format("the core reads or writes a ring at byte {}, where no record begins", byte));
    return byte / 8;
  };
  if (shown_) {
    Read& read = reads_.front();
    read.place += beat_words_;
    read.words -= static_cast<int>(beat_words_);
    if (read.words == 0) reads_.pop_front();
  }
  if (is(outputs, fetch_valid) && is(inputs, fetch_ready)) {
    const int rays = is(outputs, fetch_four) ? 4 : 1;
    const bool error = random_.below(100) < static_cast<std::uint64_t>(options_.error_percent);
    reads_.push_back({place_of(fetch_address, rays_at_, words_of_ray), rays * static_cast<int>(words_of_ray),
                      cycle_ + latency(), error});
  }
  if (is(outputs, store_valid) && is(inputs, store_ready))
    store_at_ = place_of(store_address, answers_at_, words_of_answer);
  if (is(outputs, put_valid) && is(inputs, put_ready)) {
    for (std::size_t i = 0; i < beat_words_; ++i)
      put_.push_back(static_cast<std::uint64_t>(outputs[at_[put_0] + i]));
    put_all_ = is(outputs, put_last);
  }
  if (is(inputs, stored_valid)) stored_due_.reset();
  if (store_at_ && put_all_) {
    for (std::size_t i = 0; i < put_.size(); ++i)
      answers_[(*store_at_ + i) / words_of_answer % rays_.size()][(*store_at_ + i) % words_of_answer] =
          put_[i];
    stored_due_ = cycle_ + latency();
    put_.clear();
    store_at_.reset();
    put_all_ = false;
  }
  // What the core says is in memory is there: it does not say so before it was told.
  in_memory_ += static_cast<std::uint64_t>((outputs[at_[ring_answers]] - in_memory_) &
                                           rtl::ones_below(ring_count_bits));
  ++cycle_;
}

std::optional<RingAnswer> RingBus::take() {
  if (taken_ == in_memory_) return std::nullopt;
  const std::array<std::uint64_t, 2>& words = answers_[taken_++ % rays_.size()];
  --on_their_way_;
  return RingAnswer{static_cast<std::uint32_t>(words[0] >> 32 & 0xffffff),
                    static_cast<std::uint32_t>(words[0]), static_cast<int>(words[0] >> 56),
                    static_cast<std::int64_t>(words[1])};
}

}  // namespace hitpipe::sim
