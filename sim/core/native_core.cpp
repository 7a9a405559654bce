#include "sim/core/native_core.hpp"

#include <cstdint>

#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

namespace core_parts {

using rtl::Pin;

/// An output has its number here; an input says where the number is that it is joined to.
class Part {
 public:
  explicit Part(const rtl::Part& part)
      : outputs_(part.interface.pins.size()), inputs_(part.interface.pins.size()) {}
  virtual ~Part() = default;
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  virtual void give() = 0;
  /// An output that depends on an input: whether a unit that stalls takes a test.
  virtual void give_ready() {}
  virtual void step(bool reset) = 0;
  [[nodiscard]] const std::uint64_t* output(std::size_t pin) const { return &outputs_[pin]; }
  void join(std::size_t pin, const std::uint64_t* from) { inputs_[pin] = from; }

 protected:
  std::vector<std::uint64_t> outputs_;
  std::vector<const std::uint64_t*> inputs_;
};

namespace {

/// Its pins are clk, rst, the inputs and the outputs.
class MachineInCore final : public Part {
 public:
  MachineInCore(const rtl::Part& part, rtl::Collision collision)
      : Part(part),
        machine_(part.machine->native(part.format, collision)),
        give_to_(outputs_.data() + 2 + part.graph->inputs.size()),
        take_from_(inputs_.data() + 2) {}
  void give() override { machine_->give(give_to_); }
  void step(bool reset) override { machine_->take(take_from_, reset); }

 private:
  std::unique_ptr<rtl::JoinedMachine> machine_;
  std::uint64_t* give_to_;
  const std::uint64_t* const* take_from_;
};

class UnitInCore final : public Part {
 public:
  explicit UnitInCore(const rtl::Part& part)
      : Part(part),
        evaluate_(part.design->evaluate(part.format)),
        stages_(static_cast<std::size_t>(part.pipeline->latency()) + 1),
        interval_(part.pipeline->interval()) {
    for (std::size_t i = 0; i < part.interface.pins.size(); ++i) {
      const Pin& pin = part.interface.pins[i];
      const std::uint64_t** const from = &inputs_[i];
      std::uint64_t* const to = &outputs_[i];
      if (pin.role == Pin::Role::valid && pin.is_input) in_valid_ = from;
      if (pin.role == Pin::Role::valid && !pin.is_input) out_valid_ = to;
      if (pin.role == Pin::Role::ready && pin.is_input) out_ready_ = from;
      if (pin.role == Pin::Role::ready && !pin.is_input) in_ready_ = to;
      if (pin.role == Pin::Role::tag && pin.is_input) in_tags_.push_back(from);
      if (pin.role == Pin::Role::tag && !pin.is_input) out_tags_.push_back(to);
      if (pin.role == Pin::Role::data && pin.is_input) operands_.push_back(from);
      if (pin.role == Pin::Role::data && !pin.is_input)
        results_.push_back({to, static_cast<std::uint64_t>(rtl::ones_below(pin.width))});
    }
    operand_numbers_.resize(operands_.size());
    for (Stage& stage : stages_) {
      stage.tags.resize(in_tags_.size());
      stage.results.resize(results_.size());
    }
  }

  void give() override {
    const Stage& last = stages_[next_];
    if (out_ready_ == nullptr) give_ready();
    *out_valid_ = last.valid ? 1 : 0;
    if (!last.valid) return;
    for (std::size_t i = 0; i < out_tags_.size(); ++i) *out_tags_[i] = last.tags[i];
    for (std::size_t i = 0; i < results_.size(); ++i)
      *results_[i].at = static_cast<std::uint64_t>(last.results[i]) & results_[i].mask;
  }

  void give_ready() override {
    if (in_ready_ != nullptr) *in_ready_ = advances() && phase_ == 0 ? 1 : 0;
  }

  void step(bool reset) override {
    if (!reset && !advances()) return;
    Stage& first = stages_[next_];
    next_ = next_ + 1 == stages_.size() ? 0 : next_ + 1;
    first.valid = **in_valid_ != 0 && phase_ == 0;
    phase_ = phase_ + 1 == interval_ ? 0 : phase_ + 1;
    if (reset) {
      for (Stage& stage : stages_) stage.valid = false;
      phase_ = 0;
    }
    if (!first.valid) return;
    for (std::size_t i = 0; i < in_tags_.size(); ++i) first.tags[i] = **in_tags_[i];
    for (std::size_t i = 0; i < operands_.size(); ++i)
      operand_numbers_[i] = static_cast<std::int64_t>(**operands_[i]);
    evaluate_(operand_numbers_.data(), first.results.data());
  }

 private:
  struct Data {
    std::uint64_t* at;
    std::uint64_t mask;
  };
  struct Stage {
    bool valid = false;
    std::vector<std::uint64_t> tags{};
    std::vector<std::int64_t> results{};
  };

  /// While a result waits, the whole pipeline stands still.
  [[nodiscard]] bool advances() const {
    return out_ready_ == nullptr || **out_ready_ != 0 || !stages_[next_].valid;
  }

  rtl::Evaluate evaluate_;
  std::vector<Stage> stages_;
  std::size_t next_ = 0;  ///< the oldest stage; the next test takes its place
  int interval_, phase_ = 0;
  const std::uint64_t **in_valid_ = nullptr, **out_ready_ = nullptr;
  std::uint64_t *in_ready_ = nullptr, *out_valid_ = nullptr;
  std::vector<const std::uint64_t**> in_tags_, operands_;
  std::vector<std::uint64_t*> out_tags_;
  std::vector<Data> results_;
  std::vector<std::int64_t> operand_numbers_;
};

}  // namespace

}  // namespace core_parts

NativeCore::NativeCore(const rtl::Core& core, rtl::Collision collision) {
  for (const rtl::Part& part : core.parts) {
    if (part.machine != nullptr)
      parts_.push_back(std::make_unique<core_parts::MachineInCore>(part, collision));
    else
      parts_.push_back(std::make_unique<core_parts::UnitInCore>(part));
  }
  for (const rtl::CoreWire& wire : core.wires)
    parts_[wire.to]->join(wire.input, parts_[wire.from]->output(wire.output));
  inputs_.resize(core.ports.size());
  auto input = inputs_.begin();
  for (const rtl::CorePort& port : core.ports) {
    if (!port.pin.is_input) {
      outputs_.push_back(parts_[port.ends.front().part]->output(port.ends.front().pin));
      continue;
    }
    for (const rtl::CorePort::End& end : port.ends) parts_[end.part]->join(end.pin, &*input);
    ++input;
  }
  inputs_.erase(input, inputs_.end());
}
NativeCore::~NativeCore() = default;

void NativeCore::settle() {
  for (const auto& part : parts_) part->give();
  for (const auto& part : parts_) part->give_ready();
}

void NativeCore::outputs(rtl::Word* outputs) {
  settle();
  settled_ = true;
  for (const std::uint64_t* const output : outputs_) *outputs++ = *output;
}

void NativeCore::step(const rtl::Word* inputs, bool reset) {
  if (!settled_) settle();
  settled_ = false;
  for (std::uint64_t& input : inputs_) input = static_cast<std::uint64_t>(*inputs++);
  for (const auto& part : parts_) part->step(reset);
}

}  // namespace hitpipe::sim
