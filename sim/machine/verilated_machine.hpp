// The Verilog of a machine, or of a core, as a model that can be run, made by Verilator.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/port.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "sim/model/model_library.hpp"

namespace hitpipe::sim {

/// One instance. It can stand wherever the native machine can; both give the same numbers in every cycle once
/// a reset has set them. Only one thread at a time may use an instance.
class VerilatedMachine final : public rtl::NativeMachine {
 public:
  /// Throws as ModelLibrary and rtl::Machine::graph() do. Registers begin at 0.
  VerilatedMachine(const rtl::Machine& machine, const Format& format,
                   const std::filesystem::path& cache = default_cache());
  /// The same for Verilog that was changed; its module must be the machine's, with its registers as outputs.
  VerilatedMachine(const rtl::MachineGraph& machine, const std::string& module, const std::string& verilog,
                   const std::filesystem::path& cache = default_cache());
  /// The same for a core (rtl_gen/core). Inputs and outputs are its ports, in their order; it shows no
  /// registers.
  VerilatedMachine(const rtl::Core& core, const std::string& verilog,
                   const std::filesystem::path& cache = default_cache());
  ~VerilatedMachine() override;
  /// Another instance of the same model.
  [[nodiscard]] std::unique_ptr<VerilatedMachine> another() const;
  VerilatedMachine& operator=(const VerilatedMachine&) = delete;

  void outputs(rtl::Word* outputs) override;
  void step(const rtl::Word* inputs, bool reset) override;
  void state(rtl::Word* registers) const override;

 private:
  /// Names and widths of what is driven and read.
  struct Pins {
    std::vector<rtl::Port> inputs{}, outputs{}, registers{};
  };
  static Pins pins_of(const rtl::MachineGraph& machine);
  static Pins pins_of(const rtl::Core& core);
  static std::string wrapper_of(const Pins& pins, const std::string& module);
  VerilatedMachine(const Pins& pins, const std::string& module, const std::string& verilog,
                   const std::filesystem::path& cache);
  VerilatedMachine(const VerilatedMachine& other);
  using Cycle = void (*)(void* model, bool reset, const std::uint64_t* in, std::uint64_t* registers);
  using Outputs = void (*)(void* model, std::uint64_t* out);

  std::vector<rtl::Word> masks_;  ///< of the inputs: a Verilated port must not be given bits above its width
  std::size_t inputs_, outputs_, registers_;
  std::shared_ptr<const ModelLibrary> library_;
  void* model_;
  Cycle cycle_;
  Outputs outputs_now_;
  std::vector<std::uint64_t> in_, out_, state_;  ///< two words a number
};

}  // namespace hitpipe::sim
