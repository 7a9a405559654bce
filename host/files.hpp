// Files that are read whole, files that appear whole or not at all, and folders for temporary files.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/temporary.hpp"

namespace hitpipe::host {

/// The bytes of the file. Nothing if it cannot be read, as a folder cannot.
[[nodiscard]] std::optional<std::string> contents_of(const std::filesystem::path& file);

/// The bytes of the file. Throws std::runtime_error, "FILE: COMPLAINT", if it cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& file,
                                    std::string_view complaint = "cannot read the file");

struct File {
  std::string name;
  std::string contents;
};

/// Makes the folder if it does not exist. Throws std::runtime_error, naming folder and reason, when it cannot
/// be made or written to.
void make_folder(const std::filesystem::path& folder);

/// A file that is written piece by piece beside its place, under another name. It takes its place when it is
/// renamed. Without that nothing of it is left. All functions throw std::runtime_error, naming file and
/// reason.
class PendingFile {
 public:
  /// Makes the folder. Refuses a place as check_replaceable() does (outputs.hpp).
  explicit PendingFile(std::filesystem::path place);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  void write(std::string_view text);
  /// Those who may read the file may run it too.
  void make_program();
  /// Nothing more is written. The bytes are on the disk, so a file of this name is whole even after a crash.
  void close();
  /// The file has been closed.
  void rename();

 private:
  std::filesystem::path place_;
  std::unique_ptr<Temporary> aside_;  ///< null when it has been renamed
  std::FILE* file_ = nullptr;
};

/// Writes each file whole. A file that begins with #! is a program that can be run. No file takes its place
/// before all are written, but a crash between two may leave the first without the second. Makes their
/// folders. Throws std::runtime_error, naming file and reason.
void write_files(const std::filesystem::path& folder, const std::vector<File>& files);

/// Writes one file as write_files() does.
void write_file(const std::filesystem::path& file, std::string_view contents);

/// Writes behind the end of a file that is there. The bytes are then on the disk. If they do not fit, the
/// file is as it was; if the run is killed, it may have got some of them. Throws std::runtime_error, naming
/// file and reason.
void append_to_file(const std::filesystem::path& file, std::string_view text);

/// A folder for temporary files. Its name begins with `prefix` and is unique. It is removed at the
/// end with everything in it, unless it was moved elsewhere. If the run is killed, the next folder of this
/// prefix removes it. Throws std::runtime_error, one line, when it cannot be made.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& prefix = "hitpipe-");  ///< in $TMPDIR or else /tmp
  ScratchFolder(const std::filesystem::path& parent, const std::string& prefix);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return made_->path(); }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path() / name; }

 private:
  std::unique_ptr<Temporary> made_;
};

}  // namespace hitpipe::host
