// Writes the top function of every design into a folder, and a test of each. A design that does not have the
// format takes its default one.
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "host/files.hpp"
#include "rtl_gen/emit/hls_top.hpp"

using namespace hitpipe;

namespace {

rtl::Format format_of(const rtl::Design& design, const std::string& text) {
  const rtl::FormatFamily& family = design.default_format.family();
  const auto numbers = family.parse(text);
  return numbers && family.valid(*numbers) ? rtl::Format(family, *numbers) : design.default_format;
}

std::vector<host::File> tops_and_tests(const std::string& text) {
  std::vector<host::File> files;
  std::string includes = "#include \"tests/hls/top/agreement.hpp\"\n", tests;
  for (const rtl::Design& design : rtl::designs()) {
    const rtl::Format format = format_of(design, text);
    const std::string module(design.name);
    const rtl::HlsTop top = rtl::hls_top(design, format, module);
    files.insert(files.end(), {top.header, top.source, top.csim});
    includes += fmt::format("#include \"{}\"\n#include \"{}\"\n", design.source.header, top.header.name);
    tests += fmt::format("TEST(Top, {}) {{\n  expect_agreement<{}, {}>({});\n}}\n", design.name,
                         design.source.pipeline, format.type(), rtl::hls_function(module));
  }
  files.push_back({"tops_test.cpp", fmt::format("{}\nnamespace hitpipe::hls {{\n{}}}\n", includes, tests)});
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: write_tops FOLDER FORMAT\n";
    return 2;
  }
  try {
    host::write_files(argv[1], tops_and_tests(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << "write_tops: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
