#include "rtl_gen/emit/licence.hpp"

#include <array>
#include <filesystem>
#include <string>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

/// How a comment begins in files of this ending, or of this name where there is no ending. Nothing: they have
/// none.
std::string_view comment_sign(const std::filesystem::path& file) {
  struct Kind {
    std::string_view ending, sign;
  };
  static constexpr std::array kinds{
      Kind{".v", "//"},   Kind{".sv", "//"},  Kind{".h", "//"},     Kind{".hpp", "//"}, Kind{".cpp", "//"},
      Kind{".hex", "//"}, Kind{".rdl", "//"}, Kind{".dot", "//"},   Kind{".txt", "#"},  Kind{".core", "#"},
      Kind{".tcl", "#"},  Kind{".sh", "#"},   Kind{".cfg", "#"},    Kind{".ys", "#"},   Kind{".pcf", "#"},
      Kind{".xdc", "#"},  Kind{".lpf", "#"},  Kind{"Makefile", "#"}};
  const std::string ending = file.has_extension() ? file.extension().string() : file.filename().string();
  for (const Kind& kind : kinds)
    if (kind.ending == ending) return kind.sign;
  return "";
}

}  // namespace

host::File with_licence(host::File file) {
  const std::string_view sign = comment_sign(file.name);
  if (sign.empty()) return file;
  const std::string line = fmt::format("{} SPDX-License-Identifier: {}\n", sign, output_licence);
  const bool is_second = file.contents.starts_with("#!") || file.contents.starts_with("CAPI=");
  const std::size_t at = is_second ? file.contents.find('\n') + 1 : 0;
  if (file.contents.compare(at, line.size(), line) != 0) file.contents.insert(at, line);
  return file;
}

std::vector<host::File> with_licence(std::vector<host::File> files) {
  for (host::File& file : files) file = with_licence(std::move(file));
  return files;
}

}  // namespace hitpipe::rtl
