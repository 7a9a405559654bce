// A design's emitted Verilog as a shared library, made by Verilator at run time and kept in a cache by
// content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/pipeline.hpp"
#include "sim/pins.hpp"

namespace hitpipe::sim {

/// $HITPIPE_CACHE, else $XDG_CACHE_HOME/hitpipe, else ~/.cache/hitpipe.
[[nodiscard]] std::filesystem::path default_cache();

class VerilatedDesign {
 public:
  /// Emits the design, has Verilator and the C++ compiler build it unless the cache holds just these sources,
  /// and loads it. Two processes may do so at once: each builds aside, the first to finish is kept.
  /// $VERILATOR and $CXX name other programs than `verilator` and `c++`, with arguments if need be: "env
  /// g++". Throws std::runtime_error, one line: Verilator or the compiler missing or failing (with the log's
  /// place), the cache not writable, an entry that cannot be loaded.
  VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Library& library,
                  const std::filesystem::path& cache = default_cache());

  /// The same of a unit that was made of the design at that format and has lost ports or bits of them:
  /// `verilog` is the pipeline's, its operands stay those of the whole design.
  VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Pipeline& pipeline,
                  const std::string& verilog, const std::filesystem::path& cache = default_cache());

  [[nodiscard]] int latency() const { return latency_; }
  [[nodiscard]] std::size_t operand_count() const { return operand_count_; }
  /// As the design states them; Pins::results has room for these.
  [[nodiscard]] const std::vector<hls::Result>& results() const { return results_; }

 private:
  friend class Model;
  struct Loaded;
  std::shared_ptr<const Loaded> loaded_;
  std::vector<hls::Result> results_;
  int latency_ = 0;
  std::size_t operand_count_ = 0;
};

/// One instance of a design: its registers. Instances are independent; one instance is for one thread at a
/// time.
class Model {
 public:
  /// Reset is held for as many cycles as the pipeline is long.
  explicit Model(const VerilatedDesign& design);
  ~Model();
  Model(Model&& other) noexcept;
  Model& operator=(Model&&) = delete;

  /// One clock cycle. `operands` are in port order, sign-extended when signed; needed only with
  /// pins.in_valid.
  void cycle(const std::int64_t* operands, Pins& pins) { cycle_(model_, operands, &pins); }

 private:
  std::shared_ptr<const VerilatedDesign::Loaded> loaded_;
  void* model_;
  CycleModel cycle_;
};

}  // namespace hitpipe::sim
