#include "sim/verilated_design.hpp"

#include <utility>
#include <vector>

#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "sim/model_source.hpp"
#include "sim/ray_slot_pins.hpp"

namespace hitpipe::sim {

namespace fs = std::filesystem;

struct VerilatedDesign::Loaded {
  explicit Loaded(const ModelSources& sources, const fs::path& cache) : library(sources, cache) {}

  ModelLibrary library;
  CycleModel cycle = library.entry_point<CycleModel>("hitpipe_cycle");
};

VerilatedDesign::VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Library& library,
                                 const fs::path& cache, rtl::FlowControl flow) {
  const rtl::Pipeline pipeline = rtl::make_pipeline(design.trace(format), library);
  const std::string module = design.module_at(format);
  const std::string verilog = rtl::to_verilog(
      pipeline, library, {.module_name = module, .bits = rtl::to_string(format), .flow_control = flow});
  *this = VerilatedDesign(design, format, pipeline, verilog, module, cache, {}, flow);
}

VerilatedDesign::VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Pipeline& pipeline,
                                 const std::string& verilog, const std::string& module, const fs::path& cache,
                                 const std::optional<RayMemory>& rays, rtl::FlowControl flow)
    : results_(design.results(format)), latency_(pipeline.latency()) {
  const std::vector<rtl::Port> operands = design.ports(format);
  operand_count_ = operands.size();

  ModelSources sources;
  sources.module = module;
  sources.verilog = verilog;
  if (rays) {
    ray_slots_ = rays->slots;
    ++latency_;
    sources.module = rays->slots.module();
    sources.verilog += rays->verilog;
    sources.wrapper = model_source(sources.module, operands, rays->slots.test, results_, flow,
                                   ray_slot_pins(rays->slots, operands));
  } else {
    sources.wrapper =
        model_source(sources.module, operands, rtl::input_ports(pipeline.graph), results_, flow);
  }

  loaded_ = std::make_shared<Loaded>(sources, cache);
}

Model::Model(const VerilatedDesign& design)
    : loaded_(design.loaded_), model_(loaded_->library.create()), cycle_(loaded_->cycle) {
  Pins pins{.rst = true};
  for (int i = 0; i <= design.latency(); ++i) cycle(nullptr, pins);
}

Model::Model(Model&& other) noexcept
    : loaded_(std::move(other.loaded_)), model_(std::exchange(other.model_, nullptr)), cycle_(other.cycle_) {}

Model::~Model() {
  if (model_ != nullptr) loaded_->library.destroy(model_);
}

}  // namespace hitpipe::sim
