#include "sim/core/ray_port.hpp"

#include <utility>

#include "sim/core/ring_bus.hpp"

namespace hitpipe::sim {

namespace {

using rtl::Word;
using namespace hls::channels;

class StreamPort final : public RayPort {
 public:
  explicit StreamPort(CorePins& pins) : RayPort(pins) {}

  bool offer() override {
    const bool none = waiting_.empty() || (!shown_ && pins_.happens(pins_.options.gap_percent));
    pins_.in(ray_valid) = none ? 0 : 1;
    if (none) {
      if (pins_.options.unruly)
        pins_.put_random(pins_.at[ray_tag], pins_.at[Hits::ready] - pins_.at[ray_tag]);
      return false;
    }
    if (!shown_) {
      pins_.put(pins_.at[ray_any], fields_of(*waiting_.front().job));
      pins_.in(ray_tag) = tag_of(waiting_.front().tag);
    }
    shown_ = pins_.out(ray_ready) == 0;
    if (shown_) return false;
    waiting_.pop_front();
    return true;
  }

  std::optional<Answer> answer() override {
    const bool full = pins_.options.unruly && pins_.cycles % 512 >= 384;
    takes_ = !full && !pins_.happens(pins_.options.held_percent);
    pins_.in(Hits::ready) = takes_ ? 1 : 0;
    if (!gives()) return std::nullopt;
    CoreAnswer given{.hit = {.triangle = static_cast<std::uint32_t>(pins_.out(Hits::number)),
                             .t = static_cast<std::int64_t>(pins_.out(Hits::t))},
                     .failed = static_cast<hls::Failure>(pins_.out(Hits::failed))};
    if (has_weights(pins_.core)) given.weights = weights();
    return Answer{static_cast<std::size_t>(pins_.out(Hits::tag) % tags_), given};
  }
  [[nodiscard]] bool gives() const override { return takes_ && pins_.out(Hits::valid) != 0; }
  [[nodiscard]] Word room() const override {
    return static_cast<Word>(pins_.core.options.rays) * (pins_.options.unruly ? 2 : 1);
  }

 private:
  [[nodiscard]] int width_of_field(std::size_t field) const override {
    return pins_.widths[pins_.at[ray_any] + field];
  }
  [[nodiscard]] CoreWeights weights() const {
    const hls::WorldBits world = pins_.core.options.bits.world();
    const auto number = [&](auto halves, int width) {
      return rtl::number_of(pins_.out(halves.high) << (width / 2) | pins_.out(halves.low), width);
    };
    return {number(hls::weights::HitDet(), world.determinant()), number(hls::weights::HitU(), world.edge()),
            number(hls::weights::HitV(), world.edge())};
  }

  bool shown_ = false;  ///< the first of those that wait is at the ports
  bool takes_ = false;
};

class RingPort final : public RayPort {
 public:
  explicit RingPort(CorePins& pins) : RayPort(pins), rings_(pins.core, bus_options(pins.options)) {
    rings_.show(pins_.inputs);
  }

  /// A ray is written to memory.
  bool offer() override {
    if (!waiting_.empty() && rings_.has_room() && !pins_.happens(pins_.options.gap_percent)) {
      const auto tag = static_cast<std::uint32_t>(tag_of(waiting_.front().tag));
      rings_.offer(fields_of(*waiting_.front().job), tag);
      waiting_.pop_front();
    }
    rings_.show(pins_.inputs);
    return pins_.out(ray_begins) != 0;
  }
  std::optional<Answer> answer() override {
    const std::optional<RingAnswer> found = rings_.take();
    if (!found) return std::nullopt;
    return Answer{found->tag % tags_,
                  {.hit = {.triangle = found->number, .t = found->t},
                   .failed = static_cast<hls::Failure>(found->failed)}};
  }
  [[nodiscard]] bool gives() const override {
    return pins_.out(Hits::valid) != 0 && pins_.out(Hits::ready) != 0;
  }
  void end() override { rings_.step(pins_.inputs, pins_.outputs); }
  [[nodiscard]] bool has_failed() const override { return rings_.has_failed(); }
  /// As many again wait in the rings.
  [[nodiscard]] Word room() const override {
    return 2 * static_cast<Word>(pins_.core.options.rays) * (pins_.options.unruly ? 2 : 1) + 64;
  }

 private:
  static RingBusOptions bus_options(const CoreBenchOptions& options) {
    // A ray that cannot be read has another answer.
    return {
        .unruly = options.unruly, .error_percent = options.wild_percent > 0 ? 2 : 0, .seed = options.seed};
  }
  [[nodiscard]] int width_of_field(std::size_t field) const override { return field == 0 ? 1 : 32; }

  RingBus rings_;
};

}  // namespace

/// One to four fields have another bit, one or more bits in any place, or all below a place.
void RayPort::spoil(std::vector<Word>& fields) {
  ref::adversary::Random& random = pins_.random;
  for (int left = random.between(1, 4); left > 0; --left) {
    const std::size_t i = random.below(fields.size());
    const Word bit = Word{1} << random.between(0, width_of_field(i) - 1);
    switch (random.between(0, 3)) {
      case 0:
        fields[i] ^= bit;
        break;
      case 1:
        fields[i] = random.bits() & (2 * bit - 1);
        break;
      case 2:
        fields[i] = bit;
        break;
      default:
        fields[i] = bit - 1;
    }
  }
}

std::vector<Word> RayPort::fields_of(const CoreJob& job) {
  std::vector<Word> fields = ray_fields(pins_.core, job);
  if (!pins_.happens(pins_.options.wild_percent)) return fields;
  spoil(fields);
  // The weights of a count mean nothing.
  if (has_questions(pins_.core) && has_weights(pins_.core)) fields[1] = 0;
  return fields;
}

Word RayPort::tag_of(std::size_t tag) {
  if (!pins_.options.unruly) return tag;
  const Word last_tag = rtl::ones_below(pins_.core.options.tag_bits);
  return tag + tags_ * (pins_.random.bits() % ((last_tag - tag) / tags_ + 1));
}

std::unique_ptr<RayPort> make_ray_port(CorePins& pins) {
  if (pins.at.has(ray_begins)) return std::make_unique<RingPort>(pins);
  return std::make_unique<StreamPort>(pins);
}

}  // namespace hitpipe::sim
