// Files that appear whole or not at all. Each is written beside its place under another name, then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::host {

struct File {
  std::string name;
  std::string contents;
};

/// Makes the folder if it does not exist. Throws std::runtime_error, naming folder and reason, when it cannot
/// be made or written to.
void make_folder(const std::filesystem::path& folder);

/// Writes all files or none. Makes their folders. Throws std::runtime_error, naming file and reason.
void write_files(const std::filesystem::path& folder, const std::vector<File>& files);

/// Writes one file as write_files() does.
void write_file(const std::filesystem::path& file, std::string_view contents);

}  // namespace hitpipe::host
