// A design's emitted Verilog as a model that can be run, made by Verilator.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/ray_slots.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sim/model_library.hpp"
#include "sim/pins.hpp"

namespace hitpipe::sim {

/// A memory of rays before a unit, and its Verilog.
struct RayMemory {
  rtl::RaySlots slots;
  std::string verilog;
};

class VerilatedDesign {
 public:
  /// Emits the design and loads it. Throws as ModelLibrary does.
  VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Library& library,
                  const std::filesystem::path& cache = default_cache(),
                  rtl::FlowControl flow = rtl::FlowControl::stall);

  /// The same for a unit made from the design at that format, which may have lost ports or bits of ports.
  /// `verilog` is the pipeline's, with the top `module` and that flow control. Operands stay those of the
  /// whole design. With a memory of rays, the unit is driven through it.
  VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Pipeline& pipeline,
                  const std::string& verilog, const std::string& module,
                  const std::filesystem::path& cache = default_cache(),
                  const std::optional<RayMemory>& rays = {}, rtl::FlowControl flow = rtl::FlowControl::stall);

  /// With a memory of rays: its latency too.
  [[nodiscard]] int latency() const { return latency_; }
  [[nodiscard]] const std::optional<rtl::RaySlots>& ray_slots() const { return ray_slots_; }
  [[nodiscard]] std::size_t operand_count() const { return operand_count_; }
  /// As the design states them; Pins::results has room for these.
  [[nodiscard]] const std::vector<hls::Result>& results() const { return results_; }

 private:
  friend class Model;
  struct Loaded;
  std::shared_ptr<const Loaded> loaded_;
  std::vector<hls::Result> results_;
  std::optional<rtl::RaySlots> ray_slots_;
  int latency_ = 0;
  std::size_t operand_count_ = 0;
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

 private:
  std::shared_ptr<const VerilatedDesign::Loaded> loaded_;
  void* model_;
  CycleModel cycle_;
};

}  // namespace hitpipe::sim
