#include "sim/machine/verilated_machine.hpp"

#include <fmt/format.h>

#include "rtl_gen/machine/module.hpp"
#include "sim/model/model_source.hpp"

namespace hitpipe::sim {

namespace {

/// Numbers go through as pairs of 64-bit words, the low one first. Verilator has a port of more than 64 bits
/// as an array of 32-bit words.
constexpr const char* number_functions = R"(
#include <cstdint>
#include <type_traits>

template <class Port>
void put_number(Port& port, const std::uint64_t* words) {
  if constexpr (std::is_integral_v<Port>) {
    port = static_cast<Port>(words[0]);
  } else {
    for (unsigned i = 0; i < sizeof(Port) / 4; ++i)
      port[i] = static_cast<std::uint32_t>(words[i / 2] >> (i % 2 * 32));
  }
}
template <class Port>
void get_number(const Port& port, std::uint64_t* words) {
  words[0] = words[1] = 0;
  if constexpr (std::is_integral_v<Port>) {
    words[0] = port;
  } else {
    for (unsigned i = 0; i < sizeof(Port) / 4; ++i)
      words[i / 2] |= std::uint64_t{port[i]} << (i % 2 * 32);
  }
}
)";

std::vector<rtl::Word> masks_of(const std::vector<rtl::Port>& ports) {
  std::vector<rtl::Word> masks;
  for (const rtl::Port& port : ports) masks.push_back(rtl::ones_below(port.width));
  return masks;
}

rtl::Word joined(const std::uint64_t* words) {
  return rtl::Word{words[1]} << 64 | words[0];
}

std::string verilog_of(const rtl::Machine& machine, const Format& format) {
  return rtl::to_verilog(machine.graph(format),
                         {.module = machine.module_at(format), .bits = "", .shows_state = true});
}

}  // namespace

VerilatedMachine::Pins VerilatedMachine::pins_of(const rtl::MachineGraph& machine) {
  const auto ports = [](const std::vector<hls::Field>& fields, std::string_view before) {
    std::vector<rtl::Port> made;
    for (const hls::Field& field : fields)
      made.push_back({fmt::format("{}{}", before, field.name), field.width, field.is_signed});
    return made;
  };
  return {ports(machine.inputs, ""), ports(machine.outputs, ""), ports(machine.state, "state_")};
}

VerilatedMachine::Pins VerilatedMachine::pins_of(const rtl::Core& core) {
  Pins pins;
  for (const rtl::CorePort& port : core.ports)
    (port.pin.is_input ? pins.inputs : pins.outputs)
        .push_back({port.pin.name, port.pin.width, port.pin.is_signed});
  return pins;
}

/// Outputs are read before the edge, registers behind it.
std::string VerilatedMachine::wrapper_of(const Pins& pins, const std::string& module) {
  std::string drive, read, show;
  std::size_t i = 0;
  for (const rtl::Port& port : pins.inputs)
    drive += fmt::format("  put_number(top.{}, in + {});\n", port.name, 2 * i++);
  i = 0;
  for (const rtl::Port& port : pins.outputs)
    read += fmt::format("  get_number(top.{}, out + {});\n", port.name, 2 * i++);
  i = 0;
  for (const rtl::Port& port : pins.registers)
    show += fmt::format("  get_number(top.{}, registers + {});\n", port.name, 2 * i++);
  return instance_source(module, number_functions) + fmt::format(R"(
HITPIPE_ENTRY void hitpipe_machine_outputs(void* model, std::uint64_t* out) {{
  V{0}& top = static_cast<Model*>(model)->top;
  top.clk = 0;
  top.eval();
{2}}}
HITPIPE_ENTRY void hitpipe_machine_cycle(void* model, bool reset, const std::uint64_t* in,
                                         std::uint64_t* registers) {{
  V{0}& top = static_cast<Model*>(model)->top;
  top.clk = 0;
  top.rst = reset;
{1}  top.eval();
  top.clk = 1;
  top.eval();
{3}}}
)",
                                                                 module, drive, read, show);
}

VerilatedMachine::VerilatedMachine(const rtl::Machine& machine, const Format& format,
                                   const std::filesystem::path& cache)
    : VerilatedMachine(machine.graph(format), machine.module_at(format), verilog_of(machine, format), cache) {
}

VerilatedMachine::VerilatedMachine(const rtl::MachineGraph& machine, const std::string& module,
                                   const std::string& verilog, const std::filesystem::path& cache)
    : VerilatedMachine(pins_of(machine), module, verilog, cache) {}

VerilatedMachine::VerilatedMachine(const rtl::Core& core, const std::string& verilog,
                                   const std::filesystem::path& cache)
    : VerilatedMachine(pins_of(core), core.module, verilog, cache) {}

VerilatedMachine::VerilatedMachine(const Pins& pins, const std::string& module, const std::string& verilog,
                                   const std::filesystem::path& cache)
    : masks_(masks_of(pins.inputs)),
      inputs_(pins.inputs.size()),
      outputs_(pins.outputs.size()),
      registers_(pins.registers.size()),
      library_(std::make_shared<const ModelLibrary>(ModelSources{module, verilog, wrapper_of(pins, module)},
                                                    cache)),
      model_(library_->create()),
      cycle_(library_->entry_point<Cycle>("hitpipe_machine_cycle")),
      outputs_now_(library_->entry_point<Outputs>("hitpipe_machine_outputs")),
      in_(2 * inputs_),
      out_(2 * outputs_),
      state_(2 * registers_) {}

VerilatedMachine::VerilatedMachine(const VerilatedMachine& other)
    : masks_(other.masks_),
      inputs_(other.inputs_),
      outputs_(other.outputs_),
      registers_(other.registers_),
      library_(other.library_),
      model_(library_->create()),
      cycle_(other.cycle_),
      outputs_now_(other.outputs_now_),
      in_(2 * inputs_),
      out_(2 * outputs_),
      state_(2 * registers_) {}

VerilatedMachine::~VerilatedMachine() {
  library_->destroy(model_);
}

std::unique_ptr<VerilatedMachine> VerilatedMachine::another() const {
  return std::unique_ptr<VerilatedMachine>(new VerilatedMachine(*this));
}

void VerilatedMachine::outputs(rtl::Word* outputs) {
  outputs_now_(model_, out_.data());
  for (std::size_t i = 0; i < outputs_; ++i) outputs[i] = joined(&out_[2 * i]);
}

void VerilatedMachine::step(const rtl::Word* inputs, bool reset) {
  for (std::size_t i = 0; i < inputs_; ++i) {
    const rtl::Word word = inputs[i] & masks_[i];
    in_[2 * i] = rtl::lower_half(word);
    in_[2 * i + 1] = rtl::upper_half(word);
  }
  cycle_(model_, reset, in_.data(), state_.data());
}

void VerilatedMachine::state(rtl::Word* registers) const {
  for (std::size_t i = 0; i < registers_; ++i) registers[i] = joined(&state_[2 * i]);
}

}  // namespace hitpipe::sim
