// A component library: one line says what is wrong with it, or its delays and areas are in range at every
// width and the verifier accepts a schedule of integer slabs.
#include <cstdint>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

/// Any work with the library may refuse it, but only with a message.
template <class Work>
void refusing(Work work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    expect(!std::string(error.what()).empty(), "a message says what is wrong");
  }
}

void expect_sane(const rtl::Library& library) {
  for (std::size_t i = 0; i < rtl::component_count; ++i) {
    for (const int bits : {1, 2, 3, 7, 24, 32, 63, 64, 1024}) {
      refusing([&] {
        const rtl::Cell cell = library.cell(static_cast<rtl::Component>(i), bits);
        expect(cell.bits == bits && cell.area_um2 >= 0 && cell.delay_ps > 0 && cell.stages >= 0,
               "a cell is in range");
      });
    }
  }
}

void schedule(const rtl::Library& library) {
  static const rtl::Design& design = rtl::find_design("int_slabs");
  static const rtl::Graph graph = design.trace(design.default_format);
  const rtl::Pipeline pipeline = rtl::make_pipeline(graph, library);
  expect(pipeline.latency() > 0, "a pipeline has stages");
  // Every line before the module is a comment. Text from the library must stay in it.
  const std::string verilog = rtl::to_verilog(pipeline, library, {.module_name = "int_slabs", .bits = {}});
  for (std::size_t at = 0; !verilog.substr(at).starts_with("module "); at = verilog.find('\n', at) + 1)
    expect(verilog.substr(at, 2) == "//", "the library's name stays in its comment");
  const rtl::Part part =
      rtl::unit_part(design, design.default_format, "int_slabs", pipeline, rtl::FlowControl::stall);
  expect(!rtl::manifest(part, library).dump().empty(), "a manifest is written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  refusing([&] {
    const auto library = rtl::Library::from_json({reinterpret_cast<const char*>(data), size}, "library.json");
    expect_sane(library);
    refusing([&] { schedule(library); });
  });
  return 0;
}
