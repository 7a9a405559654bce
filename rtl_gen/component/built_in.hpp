// The component libraries of the program. Every file NAME.json in rtl_gen/component/libraries is compiled in
// under the name NAME; there is no list of them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtl_gen/component/library.hpp"

namespace hitpipe::rtl {

struct BuiltInFile {
  std::string_view name;
  std::string_view json;
};
/// In the order of their names.
[[nodiscard]] std::span<const BuiltInFile> built_in_files();
[[nodiscard]] std::vector<std::string> built_in_names();

inline constexpr std::string_view default_library = "thesis_250nm";

/// The library of a built-in name, or of a file whose name ends in .json. Throws std::runtime_error with one
/// line; for an unknown name it says which names there are.
[[nodiscard]] Library library_called(std::string_view name_or_file);

}  // namespace hitpipe::rtl
