// A machine in software, by the names of its ports.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl {

class NamedPorts {
 public:
  NamedPorts(const char* machine, const Format& format) : native_(machine_called(machine)->native(format)) {
    const MachineGraph graph = machine_called(machine)->graph(format);
    for (const hls::Field& field : graph.inputs) input_places_.emplace(field.name, input_places_.size());
    for (const hls::Field& field : graph.outputs) output_places_.emplace(field.name, output_places_.size());
    inputs_.resize(input_places_.size());
    outputs_.resize(output_places_.size());
    step(true);
  }

  Word& operator[](const std::string& input) { return inputs_[input_places_.at(input)]; }
  /// In this cycle.
  [[nodiscard]] Word operator()(const std::string& output) const {
    return outputs_[output_places_.at(output)];
  }
  void step(bool reset = false) {
    native_->step(inputs_.data(), reset);
    native_->outputs(outputs_.data());
  }

 private:
  std::unique_ptr<NativeMachine> native_;
  std::map<std::string, std::size_t> input_places_, output_places_;
  std::vector<Word> inputs_, outputs_;
};

}  // namespace hitpipe::rtl
