#include "sim/core/native_core.hpp"

#include <cstdint>

#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

namespace core_parts {

using rtl::Pin;
using rtl::Word;

/// With a word for each pin.
class Part {
 public:
  explicit Part(const rtl::CorePart& part) : pins_(part.interface.pins.size()) {}
  virtual ~Part() = default;
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  virtual void give() = 0;
  /// An output that depends on an input: whether a unit that stalls takes a test.
  virtual void give_ready() {}
  virtual void step(bool reset) = 0;
  [[nodiscard]] Word* pin(std::size_t place) { return &pins_[place]; }

 protected:
  std::vector<Word> pins_;
};

namespace {

/// Its pins are clk, rst, the inputs and the outputs.
class MachineInCore final : public Part {
 public:
  MachineInCore(const rtl::CorePart& part, rtl::Collision collision)
      : Part(part),
        machine_(part.machine->native(part.format, collision)),
        inputs_(pins_.data() + 2),
        outputs_(inputs_ + part.graph->inputs.size()) {}
  void give() override { machine_->outputs(outputs_); }
  void step(bool reset) override { machine_->step(inputs_, reset); }

 private:
  std::unique_ptr<rtl::NativeMachine> machine_;
  Word *inputs_, *outputs_;
};

class UnitInCore final : public Part {
 public:
  explicit UnitInCore(const rtl::CorePart& part)
      : Part(part),
        evaluate_(part.design->evaluate(part.format)),
        stages_(static_cast<std::size_t>(part.pipeline->latency()) + 1),
        interval_(part.pipeline->interval()) {
    for (std::size_t i = 0; i < part.interface.pins.size(); ++i) {
      const Pin& pin = part.interface.pins[i];
      Word* const at = &pins_[i];
      if (pin.role == Pin::Role::valid) (pin.is_input ? in_valid_ : out_valid_) = at;
      if (pin.role == Pin::Role::tag) (pin.is_input ? in_tags_ : out_tags_).push_back(at);
      if (pin.role == Pin::Role::ready) (pin.is_input ? out_ready_ : in_ready_) = at;
      if (pin.role != Pin::Role::data) continue;
      (pin.is_input ? operands_ : results_).push_back({at, rtl::ones_below(pin.width)});
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
      *results_[i].at = static_cast<Word>(last.results[i]) & results_[i].mask;
  }

  void give_ready() override {
    if (in_ready_ != nullptr) *in_ready_ = advances() && phase_ == 0 ? 1 : 0;
  }

  void step(bool reset) override {
    if (!reset && !advances()) return;
    Stage& first = stages_[next_];
    next_ = next_ + 1 == stages_.size() ? 0 : next_ + 1;
    first.valid = *in_valid_ != 0 && phase_ == 0;
    phase_ = phase_ + 1 == interval_ ? 0 : phase_ + 1;
    if (reset) {
      for (Stage& stage : stages_) stage.valid = false;
      phase_ = 0;
    }
    if (!first.valid) return;
    for (std::size_t i = 0; i < in_tags_.size(); ++i) first.tags[i] = *in_tags_[i];
    for (std::size_t i = 0; i < operands_.size(); ++i)
      operand_numbers_[i] = static_cast<std::int64_t>(*operands_[i].at);
    evaluate_(operand_numbers_.data(), first.results.data());
  }

 private:
  struct Data {
    Word* at;
    Word mask;
  };
  struct Stage {
    bool valid = false;
    std::vector<Word> tags{};
    std::vector<std::int64_t> results{};
  };

  /// While a result waits, the whole pipeline stands still.
  [[nodiscard]] bool advances() const {
    return out_ready_ == nullptr || *out_ready_ != 0 || !stages_[next_].valid;
  }

  rtl::Evaluate evaluate_;
  std::vector<Stage> stages_;
  std::size_t next_ = 0;  ///< the oldest stage; the next test takes its place
  int interval_, phase_ = 0;
  Word *in_valid_ = nullptr, *in_ready_ = nullptr, *out_valid_ = nullptr, *out_ready_ = nullptr;
  std::vector<Word*> in_tags_, out_tags_;
  std::vector<Data> operands_, results_;
  std::vector<std::int64_t> operand_numbers_;
};

}  // namespace

}  // namespace core_parts

NativeCore::NativeCore(const rtl::Core& core, rtl::Collision collision) {
  for (const rtl::CorePart& part : core.parts) {
    if (part.machine != nullptr)
      parts_.push_back(std::make_unique<core_parts::MachineInCore>(part, collision));
    else
      parts_.push_back(std::make_unique<core_parts::UnitInCore>(part));
  }
  for (const rtl::CoreWire& wire : core.wires)
    wires_.push_back({parts_[wire.from]->pin(wire.output), parts_[wire.to]->pin(wire.input)});
  for (const rtl::CorePort& port : core.ports) {
    if (!port.pin.is_input) {
      outputs_.push_back(parts_[port.ends.front().part]->pin(port.ends.front().pin));
      continue;
    }
    inputs_.emplace_back();
    for (const rtl::CorePort::End& end : port.ends) inputs_.back().push_back(parts_[end.part]->pin(end.pin));
  }
}
NativeCore::~NativeCore() = default;

void NativeCore::settle() {
  for (const auto& part : parts_) part->give();
  for (const Copy& wire : wires_) *wire.to = *wire.from;
  for (const auto& part : parts_) part->give_ready();
}

void NativeCore::outputs(rtl::Word* outputs) {
  settle();
  settled_ = true;
  for (const rtl::Word* const output : outputs_) *outputs++ = *output;
}

void NativeCore::step(const rtl::Word* inputs, bool reset) {
  if (!settled_) settle();
  settled_ = false;
  for (const std::vector<rtl::Word*>& places : inputs_) {
    for (rtl::Word* const place : places) *place = *inputs;
    ++inputs;
  }
  for (const auto& part : parts_) part->step(reset);
}

}  // namespace hitpipe::sim
