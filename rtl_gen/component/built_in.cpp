#include "rtl_gen/component/built_in.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const BuiltInFile& file : built_in_files()) names.emplace_back(file.name);
  return names;
}

Library library_called(std::string_view name_or_file) {
  if (name_or_file.ends_with(".json")) return Library::load(name_or_file);
  const auto files = built_in_files();
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const BuiltInFile& file) { return file.name == name_or_file; });
  if (found == files.end()) {
    throw std::runtime_error(
        fmt::format("library {}: unknown; there are {}, and any file whose name ends in .json", name_or_file,
                    fmt::join(built_in_names(), ", ")));
  }
  return Library::from_json(found->json, fmt::format("{}.json", found->name));
}

const Library& Library::thesis() {
  static const Library library = library_called(default_library);
  return library;
}

}  // namespace hitpipe::rtl
