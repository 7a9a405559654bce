// Temporary files and folders that belong to a run. Their names are random, so no two runs have the same, on
// whatever machines. A run holds a lock (flock) on each while it lives. What a dead run has left, the next
// one removes. A signal that ends the program removes them too, if the program has called
// end_by_signals_cleanly().
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "host/ending.hpp"

namespace hitpipe::host {

/// A file or folder that this process has made under a random name, with the lock on it. It stays when the
/// object goes.
class Temporary {
 public:
  enum class Kind { file, folder };

  /// Makes `folder`/`prefix`RANDOM. Removes what dead runs have left there under the same prefix: a run is
  /// dead if nobody holds its lock. A lock need not reach other machines, so what one of them has made stays
  /// for a day. Throws std::system_error.
  Temporary(Kind kind, const std::filesystem::path& folder, std::string_view prefix);
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Open for writing if it is a file. The lock lasts as long as this descriptor or a duplicate of it.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::optional<AtEnding> at_ending_;
};

}  // namespace hitpipe::host
