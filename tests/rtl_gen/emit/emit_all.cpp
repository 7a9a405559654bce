// Writes every design in several formats below a folder: built by two compilers, whose files must be the
// same.
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>

#include "rtl_gen/emit/files.hpp"

int main(int argc, char** argv) {
  using namespace hitpipe::rtl;
  try {
    if (argc != 2) throw std::runtime_error("usage: emit_all FOLDER");
    for (const Design& design : designs()) {
      for (const char* text : {"24/24", "20/24", "16/16", "6/11", "32/63"}) {
        const auto bits = parse_bits(text);
        std::string format = text;
        std::replace(format.begin(), format.end(), '/', '_');
        const Pipeline pipeline = make_pipeline(design.trace(bits), Library::thesis());
        std::vector<File> files = emit(design, bits, Library::thesis(), pipeline);
        // As recorded, before canonical() has put it in order: the compilers may differ here.
        files.push_back({"recorded.txt", to_text(design.trace(bits))});
        write_files(std::filesystem::path(argv[1]) / std::string(design.name) / format, files);
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
