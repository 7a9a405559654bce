// Files that appear whole or not at all. Each is written beside its place under another name, then renamed.
#pragma once

#include <cstdio>
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

/// A file that is written piece by piece. It takes its place when it is renamed. Without that nothing of it
/// is left. All functions throw std::runtime_error, naming file and reason.
class PendingFile {
 public:
  /// Makes the folder. Refuses a place that is a folder or a device such as /dev/null.
  explicit PendingFile(std::filesystem::path place);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void write(std::string_view text);
  /// Nothing more is written.
  void close();
  /// The file has been closed.
  void rename();

 private:
  std::filesystem::path place_;
  std::filesystem::path aside_;  ///< empty when it has been renamed
  std::FILE* file_ = nullptr;
};

/// Writes all files or none. Makes their folders. Throws std::runtime_error, naming file and reason.
void write_files(const std::filesystem::path& folder, const std::vector<File>& files);

/// Writes one file as write_files() does.
void write_file(const std::filesystem::path& file, std::string_view contents);

}  // namespace hitpipe::host
