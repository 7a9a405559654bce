// What a file or folder does not let us do.
#pragma once

#include <filesystem>
#include <string_view>

namespace hitpipe::host {

/// Throws std::runtime_error: "PATH: cannot WHAT: the system's words for this error number".
[[noreturn]] void cannot(std::string_view what, const std::filesystem::path& path, int error);

}  // namespace hitpipe::host
