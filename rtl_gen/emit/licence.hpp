// The licence of what hitpipe writes. It belongs to the user: whoever has a file may do with it what they
// want.
#pragma once

#include <string_view>
#include <vector>

#include "host/files.hpp"

namespace hitpipe::rtl {

/// Its identifier in SPDX's list.
inline constexpr std::string_view output_licence = "0BSD";

/// The files, each with a line "SPDX-License-Identifier: 0BSD" in a comment. The line is the first, or the
/// second where a file's kind wants another one there; one that is there is not written again. A file whose kind has no
/// comments stays as it is: JSON says its licence in a member.
[[nodiscard]] std::vector<host::File> with_licence(std::vector<host::File> files);
[[nodiscard]] host::File with_licence(host::File file);

}  // namespace hitpipe::rtl
