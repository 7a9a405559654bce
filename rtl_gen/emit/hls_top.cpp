#include "rtl_gen/emit/hls_top.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/emit/hls_scripts.hpp"

namespace hitpipe::rtl {

namespace {

constexpr std::size_t columns = 110;  // as .clang-format has it

std::string top_type(int width, bool is_signed) {
  if (width == 1 && !is_signed) return "Bit";
  return fmt::format("{}<{}>", is_signed ? "Integer" : "Pattern", width);
}

/// " --name N", or nothing for the name that the unit has by itself.
std::string name_option(const Design& design, const Format& format, const std::string& module) {
  return module == design.module_at(format) ? "" : " --name " + module;
}

/// The function with its arguments, then `end`, wrapped as clang-format does. `types` is the prefix of its
/// types.
std::string signature(const Design& design, const Format& format, const std::string& module,
                      const std::string& types, const std::string& end) {
  std::vector<std::string> arguments;
  for (const Port& port : design.ports(format))
    arguments.push_back(fmt::format("{}{} {}", types, top_type(port.width, port.is_signed), port.name));
  for (const hls::Result& result : design.results(format))
    arguments.push_back(
        fmt::format("{}{}& {}", types, top_type(result.width, result.is_signed), result.name));

  std::string text = fmt::format("void {}(", hls_function(module));
  const std::string indent(text.size(), ' ');
  std::size_t column = text.size();
  for (const std::string& argument : arguments) {
    const bool first = &argument == &arguments.front();
    const std::size_t tail = &argument == &arguments.back() ? end.size() : 1;
    if (!first && column + 1 + argument.size() + tail > columns) {
      text += ",\n" + indent + argument;
      column = indent.size() + argument.size() + 1;
      continue;
    }
    text += (first ? "" : ", ") + argument;
    column += argument.size() + (first ? 1 : 2);
  }
  return text + end;
}

std::string header(const Design& design, const Format& format, const std::string& module) {
  return fmt::format(R"(// Top function of {} for high-level synthesis: {}.
// Written by `hitpipe rtl {}{}{} --hls`.
#pragma once

#include "hls/top/top_domain.hpp"

{}
)",
                     design.name_at(format), design.summary, design.name, design.bits_option(format),
                     name_option(design, format, module),
                     signature(design, format, module, "hitpipe::hls::top::", ");"));
}

std::string source(const Design& design, const Format& format, const std::string& module) {
  std::string interfaces, operands, results;
  for (const Port& port : design.ports(format)) {
    interfaces += fmt::format("#pragma HLS INTERFACE mode = ap_none port = {}\n", port.name);
    operands +=
        fmt::format("  in.{}{} = {};\n", port.name, port.kind == hls::Kind::real ? ".bits" : "", port.name);
  }
  for (const hls::Result& result : design.results(format)) {
    interfaces += fmt::format("#pragma HLS INTERFACE mode = ap_vld port = {}\n", result.name);
    results += fmt::format("  {} = out.{};\n", result.name, result.name);
  }
  return fmt::format(
      R"(// One test a cycle: operands are plain ports, taken when the block starts; a result comes with a valid bit.
#include "{name}.hpp"

#include "{header}"

using namespace hitpipe::hls;

{signature}
#if defined(__SYNTHESIS__) && !defined(HITPIPE_AC_TYPES)
#pragma HLS PIPELINE II = 1
{interfaces}#endif
  using Format = {format};
  {pipeline}::Operands<top::Domain, Format> in;
{operands}  const auto out = {pipeline}::test<top::Domain>(Format(), in);
{results}}}
)",
      fmt::arg("name", module), fmt::arg("header", design.source.header),
      fmt::arg("signature", signature(design, format, module, "top::", ") {")),
      fmt::arg("interfaces", interfaces), fmt::arg("format", format.type()),
      fmt::arg("pipeline", design.source.pipeline), fmt::arg("operands", operands),
      fmt::arg("results", results));
}

std::string csim(const Design& design, const Format& format, const std::string& module) {
  std::vector<std::string> includes{"hls/top/csim.hpp", module + ".hpp"};
  std::sort(includes.begin(), includes.end());
  return fmt::format(
      R"(// C simulation of the top function of {0}: replays vectors and compares the results.
//   csim [FILE]    {1}_vectors.hex unless given
#include "{3}"
#include "{4}"

int main(int argc, char** argv) {{
  return hitpipe::hls::top::csim(argc, argv, "{1}_vectors.hex", {2});
}}
)",
      design.name_at(format), module, hls_function(module), includes[0], includes[1]);
}

}  // namespace

std::vector<host::File> HlsTop::files() const {
  std::vector<host::File> all{header, source, csim};
  all.insert(all.end(), scripts.begin(), scripts.end());
  return all;
}

HlsTop hls_top(const Design& design, const Format& format, const std::string& module) {
  if (design.source.pipeline.empty())
    throw std::runtime_error(
        fmt::format("{}: no top function for high-level synthesis; the design does not say where its C++ is",
                    design.name));
  return {.header = {module + ".hpp", header(design, format, module)},
          .source = {module + ".cpp", source(design, format, module)},
          .csim = {module + "_csim.cpp", csim(design, format, module)},
          .scripts = hls_scripts(design.name_at(format), module)};
}

std::string hls_function(const std::string& module) {
  return "hitpipe_" + module;
}

}  // namespace hitpipe::rtl
