// Writes into a folder the top function of every design, its vectors, and a program that replays them all. A
// design that does not have the format takes its default one. The files of a design without a top are empty.
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/files.hpp"
#include "rtl_gen/emit/hls_top.hpp"
#include "rtl_gen/emit/vectors.hpp"

using namespace hitpipe;

namespace {

constexpr int vector_count = 20'000;
constexpr std::uint64_t seed = 91;

hitpipe::Format format_of(const rtl::Design& design, const std::string& text) {
  const hitpipe::FormatFamily& family = design.default_format.family();
  const auto numbers = family.parse(text);
  return numbers && family.valid(*numbers) ? hitpipe::Format(family, *numbers) : design.default_format;
}

/// Half of the vectors hit.
std::string vectors_of(const rtl::Design& design, const hitpipe::Format& format) {
  const std::vector<rtl::Port> ports = design.ports(format);
  rtl::DrawVectors draw(ports, {}, design.evaluate(format), seed);
  std::vector<rtl::Vector> vectors;
  for (int i = 0; i < vector_count; ++i) vectors.push_back(draw());
  return rtl::vector_file(ports, ports, design.results(format), vectors);
}

std::vector<host::File> tops_and_program(const std::string& text) {
  std::vector<host::File> files;
  std::string includes = "#include \"hls/top/csim.hpp\"\n", calls;
  for (const rtl::Design& design : rtl::designs()) {
    const hitpipe::Format format = format_of(design, text);
    const std::string module(design.name);
    if (design.source.pipeline.empty()) {
      const std::string text_of_none = fmt::format("// {} has no top function.\n", module);
      files.insert(files.end(), {{module + ".hpp", text_of_none}, {module + ".cpp", text_of_none}});
      continue;
    }
    const rtl::HlsTop top = rtl::hls_top(design, format, module);
    const std::string vectors = module + "_vectors.hex";
    files.insert(files.end(), {top.header, top.source, {vectors, vectors_of(design, format)}});
    includes += fmt::format("#include \"{}\"\n", top.header.name);
    calls += fmt::format("  wrong += hitpipe::hls::top::csim(1, argv, \"{}\", {}) != 0;\n", vectors,
                         rtl::hls_function(module));
  }
  files.push_back(
      {"replay.cpp", fmt::format("{}\nint main(int /*argc*/, char** argv) {{\n  int wrong = 0;\n{}"
                                 "  return wrong;\n}}\n",
                                 includes, calls)});
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: write_tops FOLDER FORMAT\n";
    return 2;
  }
  try {
    host::write_files(argv[1], tops_and_program(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << "write_tops: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
