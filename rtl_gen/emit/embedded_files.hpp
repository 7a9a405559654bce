// Files of the tree in other languages than C++, or in C++ that is not the program's, which it writes out.
#pragma once

#include <span>
#include <string_view>

namespace hitpipe::rtl {

struct EmbeddedFile {
  std::string_view name, text;
};

/// The files of rtl_gen/core/harness, in the order of their names. The build writes this function.
[[nodiscard]] std::span<const EmbeddedFile> harness_files();
/// Those of rtl_gen/emit/testbench. MODULE in them stands for the name of a unit's module. The build writes this too.
[[nodiscard]] std::span<const EmbeddedFile> testbench_files();

}  // namespace hitpipe::rtl
