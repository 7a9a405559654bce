// Shows on a terminal what is being done, on one line of standard error. After two seconds a bar shows how
// much is done. The line disappears when the work is done.
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

  /// Sets the finished share, 0..1. Any thread may call it. Not called for work whose share is unknown.
  void show(double share);

 private:
  std::string what_;
  bool terminal_;
  double shown_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::mutex drawing_;
};

}  // namespace hitpipe::cli
