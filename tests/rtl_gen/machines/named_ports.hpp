// A machine as software, whose ports tests find by name, so that a test does not depend on their order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rtl_gen/graph/word.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl {

/// The inputs or the outputs of a machine, a word for each.
class NamedPorts {
 public:
  explicit NamedPorts(const std::vector<hls::Field>& fields) : words_(fields.size(), 0) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      places_[fields[i].name] = i;
      widths_.push_back(fields[i].width);
    }
  }

  /// Throws std::out_of_range when there is no such port.
  Word& operator[](const std::string& name) { return words_[places_.at(name)]; }
  [[nodiscard]] Word operator[](const std::string& name) const { return words_[places_.at(name)]; }
  /// The number as the port has it: its low bits.
  [[nodiscard]] Word bits_of(const std::string& name, std::int64_t number) const {
    return static_cast<Word>(number) & ones_below(widths_[places_.at(name)]);
  }
  void put(const std::string& name, std::int64_t number) { (*this)[name] = bits_of(name, number); }
  /// Any words, since a machine must not look at those that mean nothing now.
  void scramble(Seeded& random) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] = random.bits() & ones_below(widths_[i]);
  }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }
  Word* data() { return words_.data(); }

 private:
  std::map<std::string, std::size_t> places_;
  std::vector<int> widths_;
  std::vector<Word> words_;
};

/// In one cycle a test calls give(), then looks at `out` and fills `in`, then calls step().
class NamedMachine {
 public:
  /// Resets it.
  NamedMachine(std::string_view name, const Format& format)
      : NamedMachine(machine_called(name)->graph(format), machine_called(name)->native(format)) {}

  void give() { machine_->outputs(out.data()); }
  void step() { machine_->step(in.data(), false); }

 private:
  NamedMachine(const MachineGraph& graph, std::unique_ptr<NativeMachine> machine)
      : in(graph.inputs), out(graph.outputs), machine_(std::move(machine)) {
    give();
    machine_->step(in.data(), true);
  }

 public:
  NamedPorts in, out;

 private:
  std::unique_ptr<NativeMachine> machine_;
};

}  // namespace hitpipe::rtl
