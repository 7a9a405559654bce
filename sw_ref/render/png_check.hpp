// Whether a PNG file is whole, before libpng reads it: libpng writes about a damaged one to standard error
// itself.
#pragma once

#include <filesystem>

namespace hitpipe::ref {

/// Checks signature, length and checksum of each chunk up to IEND (ISO/IEC 15948, 5). Throws
/// std::runtime_error, one line, for what is wrong. A file without the signature is left to other readers.
void check_png(const std::filesystem::path& file);

}  // namespace hitpipe::ref
