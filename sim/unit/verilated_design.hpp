// A unit's Verilog as a model that can be run, made by Verilator.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "rtl_gen/emit/unit.hpp"
#include "sim/model/model_library.hpp"
#include "sim/model/pins.hpp"

namespace hitpipe::sim {

class VerilatedDesign {
 public:
  /// The model takes the operands of the whole design. Throws as ModelLibrary does.
  explicit VerilatedDesign(rtl::Unit unit, const std::filesystem::path& cache = default_cache());

  [[nodiscard]] const rtl::Unit& unit() const;
  [[nodiscard]] int latency() const { return latency_; }
  [[nodiscard]] std::size_t operand_count() const { return operand_count_; }
  /// As the design states them; Pins::results has room for these.
  [[nodiscard]] const std::vector<hls::Result>& results() const { return results_; }

 private:
  friend class Model;
  struct Loaded;
  std::shared_ptr<const Loaded> loaded_;
  std::vector<hls::Result> results_;
  int latency_;
  std::size_t operand_count_;
};

/// One instance of a design, with its own registers. Instances are independent. Only one thread at a time may
/// use an instance.
class Model {
 public:
  /// Holds reset for as many cycles as the pipeline has stages.
  explicit Model(const VerilatedDesign& design);
  ~Model();
  Model(Model&& other) noexcept;
  Model& operator=(Model&&) = delete;

  /// One clock cycle. `operands` are in port order, sign-extended when signed. They are needed only with
  /// pins.in_valid.
  void cycle(const std::int64_t* operands, Pins& pins) { cycle_(model_, operands, &pins); }
  [[nodiscard]] const VerilatedDesign& design() const { return design_; }

 private:
  VerilatedDesign design_;
  void* model_;
  CycleModel cycle_;
};

}  // namespace hitpipe::sim
