#include "sim/unit/verilated_design.hpp"

#include <utility>

#include "sim/model/model_source.hpp"

namespace hitpipe::sim {

namespace {

ModelSources sources_of(const rtl::Unit& unit, const std::vector<hls::Result>& results) {
  return {unit.module(), unit.verilog,
          model_source(unit.module(), unit.ports(), rtl::input_ports(unit.pipeline->graph), results,
                       unit.flow_control(), unit.interval())};
}

}  // namespace

struct VerilatedDesign::Loaded {
  Loaded(rtl::Unit of, const std::vector<hls::Result>& results, const std::filesystem::path& cache)
      : unit(std::move(of)), library(sources_of(unit, results), cache) {}

  rtl::Unit unit;
  ModelLibrary library;
  CycleModel cycle = library.entry_point<CycleModel>("hitpipe_cycle");
};

VerilatedDesign::VerilatedDesign(rtl::Unit unit, const std::filesystem::path& cache)
    : results_(unit.design->results(unit.format)),
      latency_(unit.pipeline->latency()),
      operand_count_(unit.ports().size()) {
  loaded_ = std::make_shared<Loaded>(std::move(unit), results_, cache);
}

const rtl::Unit& VerilatedDesign::unit() const {
  return loaded_->unit;
}

Model::Model(const VerilatedDesign& design)
    : design_(design), model_(design_.loaded_->library.create()), cycle_(design_.loaded_->cycle) {
  Pins pins{.rst = true};
  for (int i = 0; i <= design.latency(); ++i) cycle(nullptr, pins);
}

Model::Model(Model&& other) noexcept
    : design_(std::move(other.design_)), model_(std::exchange(other.model_, nullptr)), cycle_(other.cycle_) {}

Model::~Model() {
  if (model_ != nullptr) design_.loaded_->library.destroy(model_);
}

}  // namespace hitpipe::sim
