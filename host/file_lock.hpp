// One process at a time does something; the others wait.
#pragma once

#include <cstdint>
#include <filesystem>

namespace hitpipe::host {

/// Locks one number in a file that only serves for that, and stays. Waits for other processes and threads
/// that hold the same number. The lock of a process that is killed ends with it. Where files have no locks,
/// nobody waits.
class FileLock {
 public:
  /// Makes the file. The highest bit of the number does not count. Throws std::system_error when the file
  /// cannot be opened.
  FileLock(const std::filesystem::path& file, std::uint64_t number);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace hitpipe::host
