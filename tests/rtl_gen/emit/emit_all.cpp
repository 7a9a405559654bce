// Writes every design in several formats below a folder. Built by two compilers, it must write the same
// files.
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "hls/box/int_format.hpp"
#include "hls/box/major_format.hpp"
#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"

int main(int argc, char** argv) {
  using namespace hitpipe::rtl;
  try {
    if (argc != 2) throw std::runtime_error("usage: emit_all FOLDER");
    for (const Design& design : designs()) {
      const hitpipe::Format& usual = design.default_format;
      const std::vector<std::string> formats =
          usual.is<hitpipe::hls::IntBits>()
              ? std::vector<std::string>{"24/24", "20/24", "16/16", "6/11", "32/63"}
          : usual.is<hitpipe::hls::MajorBits>() ? std::vector<std::string>{"20+1/13", "8+3/6f-1"}
                                                : std::vector<std::string>{to_string(usual)};
      for (std::string folder : formats) {
        const hitpipe::Format format = design.parse_format(folder);
        std::replace(folder.begin(), folder.end(), '/', '_');
        const Pipeline pipeline = make_pipeline(design.trace(format), Library::thesis());
        std::vector<File> files =
            emit(make_unit(design, format, Library::thesis(), pipeline), {.axi_stream = true}).files();
        // The graph as recorded, before canonical() puts it in order. Compilers may differ here.
        files.push_back({"recorded.txt", to_text(design.trace(format))});
        hitpipe::host::write_files(std::filesystem::path(argv[1]) / std::string(design.name) / folder, files);
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
