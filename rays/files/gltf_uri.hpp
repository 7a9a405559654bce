// Where the bytes of a glTF buffer are: in the URI itself, or in a file beside the mesh.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rays/files/json_place.hpp"

namespace hitpipe::ref {

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The bytes of a data URI in base64. `place` is named if it is another.
[[nodiscard]] std::string decoded_data_uri(const Place& place, std::string_view uri);

/// The name of the file: %20 is a blank. Refuses all but relative names.
[[nodiscard]] std::string decoded_file_uri(const Place& place, std::string_view uri);

/// A message has the name of the file as the mesh says it.
[[nodiscard]] std::string buffer_file_bytes(const std::filesystem::path& file, const std::string& name);

}  // namespace hitpipe::ref
