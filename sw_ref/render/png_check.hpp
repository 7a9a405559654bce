// Checks that a PNG file is whole before libpng reads it, because libpng itself writes to standard error
// about a damaged one.
#pragma once

#include <filesystem>

namespace hitpipe::ref {

/// Checks signature, length and checksum of each chunk up to IEND (ISO/IEC 15948, 5). Throws
/// std::runtime_error, one line that says what is wrong. Ignores a file without the signature; other readers
/// check it.
void check_png(const std::filesystem::path& file);

}  // namespace hitpipe::ref
