#include "cli/commands/cores.hpp"

#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "host/files.hpp"
#include "rtl_gen/core/files.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/core/core_vectors.hpp"

namespace hitpipe::cli {

void emit_core(const rtl::CoreOptions& core_options, const CoreRtl& options) {
  const std::string module = options.module.empty() ? core_name : options.module;
  rtl::check_module_name(module);
  const rtl::Library library = rtl::library_called(options.library);
  const rtl::Core core = rtl::make_core(core_options, library, module);
  const std::vector<host::File> files =
      rtl::core_files(core, library, sim::core_test(core, options.cycles, options.seed));
  host::write_files(options.out, files);
  std::vector<std::string> names;
  for (const host::File& file : files)
    names.push_back((std::filesystem::path(options.out) / file.name).string());
  const Row row{{"core", module},
                {"bits", rtl::to_string(rtl::Format(core.options.bits))},
                {"rays", core.options.rays},
                {"pair_latency", core.part("pair").pipeline->latency()},
                {"triangle_latency", core.part("triangle").pipeline->latency()},
                {"clock_ps", core.clock_ps},
                {"library", library.name()},
                {"cycles", options.cycles},
                {"files", names}};
  fmt::print("{}", record_text(row, options.format));
}

}  // namespace hitpipe::cli
