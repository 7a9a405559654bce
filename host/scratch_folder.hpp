// A folder for temporary files.
#pragma once

#include <filesystem>
#include <string>

namespace hitpipe::host {

/// Its name begins with `prefix` and is unique. It is removed at the end with everything in it, unless it was
/// moved elsewhere. Throws std::runtime_error, one line, when it cannot be made.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& prefix = "hitpipe-");  ///< in $TMPDIR or else /tmp
  ScratchFolder(const std::filesystem::path& parent, const std::string& prefix);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace hitpipe::host
