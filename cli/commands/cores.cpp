#include "cli/commands/cores.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "area_model/core_price.hpp"
#include "area_model/figure.hpp"
#include "cli/text/implementation_text.hpp"
#include "cli/text/progress.hpp"
#include "host/files.hpp"
#include "rtl_gen/core/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/core/core_vectors.hpp"
#include "sim/implement/core_implementation.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::cli {

void emit_core(const rtl::CoreOptions& core_options, const CoreRtl& options) {
  if (!options.module.empty()) rtl::check_module_name(options.module);
  const rtl::Library library = rtl::library_called(options.library);
  const rtl::Core core = rtl::make_core(core_options, library, options.module);
  std::vector<host::File> files =
      rtl::core_files(core, library, sim::core_test(core, options.cycles, options.seed));
  rtl::add_drawings(files);
  host::write_files(options.out, files);
  std::vector<std::string> names;
  for (const host::File& file : files)
    names.push_back((std::filesystem::path(options.out) / file.name).string());
  Row row{{"core", core.module},
          {"bits", rtl::to_string(rtl::Format(core.options.bits))},
          {"rays", core.options.rays},
          {"door", rtl::door_name(core.options.door)}};
  for (const rtl::CorePart& part : core.parts)
    if (part.pipeline) row[fmt::format("{}_latency", part.name)] = part.pipeline->latency();
  row.update(Row{{"clock_ps", core.clock_ps},
                 {"library", library.name()},
                 {"cycles", options.cycles},
                 {"files", names}});
  fmt::print("{}", record_text(row, options.format));
}

void print_core_price(const rtl::CoreOptions& core_options, const std::string& library_name,
                      OutputFormat format) {
  const rtl::Library library = rtl::library_called(library_name);
  const rtl::Core core = rtl::make_core(core_options, library);
  const area::CorePrice price = area::price(core, library);
  std::vector<Row> rows;
  const auto add = [&](std::string_view part, const rtl::Format& bits, const area::CorePartPrice& of) {
    Row row{{"part", part}, {"bits", rtl::to_string(bits)}, {"memory_bits", of.memory_bits}};
    if (library.chip() == nullptr) {
      const std::string digits = area::area_mm2(of.area_um2);
      row["area_mm2"] = format == OutputFormat::json ? Row::parse(digits) : Row(digits);
    } else {
      row["lut"] = of.taken.luts;
      row["ff"] = of.taken.registers;
      row["dsp"] = of.taken.blocks;
    }
    rows.push_back(row);
  };
  for (std::size_t i = 0; i < core.parts.size(); ++i)
    add(core.parts[i].name, core.parts[i].format, price.parts[i]);
  add("core", core.options.bits, price.all);
  fmt::print("{}", table_text(rows, format));
}

int map_core(const rtl::CoreOptions& core_options, const std::string& target_name,
             const sim::ImplementOptions& given, OutputFormat format) {
  const sim::Target target = sim::target_called(target_name);
  std::optional<Progress> progress;
  sim::ImplementOptions options = given;
  options.progress = [&](const std::string& step) { progress.emplace(step); };
  const sim::CoreImplementation core = sim::implement_core(core_options, target, options);
  progress.reset();

  const std::string bits = rtl::to_string(rtl::Format(core_options.bits));
  Row row{{"core", core.chip.module}, {"bits", bits},        {"rays", core_options.rays},
          {"target", target.name},    {"chip", target.chip}, {"library", core.chip.library},
          {"clock_ps", core.clock_ps}};
  row.update(taken_row(core.chip));
  row["memory_bits"] = core.memory_bits;
  row.update(tools_row(core.chip));
  keep_and_print(std::move(row), options.folder / target.name / (core.chip.module + "_implementation.json"),
                 format);
  const std::string fault = fault_of(target, core.chip);
  if (fault.empty()) return 0;
  fmt::print(stderr, "hitpipe: core {} {}\n", bits, fault);
  return 1;
}

void refuse_core_options(const CLI::App& command, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (command.count(name) > 0)
      throw std::runtime_error(fmt::format("{}: allowed with {} only", name, core_name));
}

}  // namespace hitpipe::cli
