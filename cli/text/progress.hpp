// On a terminal only, on one line of standard error: what is being done, and after two seconds a bar of how
// much of it. The line is gone when the work is done.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace hitpipe::cli {

class Progress {
 public:
  /// Shows `what` at once.
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The finished share, 0..1; may be called from any thread. Work whose share is not known never calls it.
  void show(double share);

 private:
  std::string what_;
  bool terminal_;
  double shown_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::mutex drawing_;
};

}  // namespace hitpipe::cli
