// Files that appear whole or not at all: each is written under another name beside its place, then renamed.
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

/// Makes the folder unless it is there. Throws std::runtime_error naming it and the reason when it cannot be
/// made or written to.
void make_folder(const std::filesystem::path& folder);

/// Writes all files or none. Makes the folders. Throws std::runtime_error naming the file and the reason.
void write_files(const std::filesystem::path& folder, const std::vector<File>& files);

/// One file, as write_files() does.
void write_file(const std::filesystem::path& file, std::string_view contents);

}  // namespace hitpipe::host
