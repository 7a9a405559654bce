// Long work looks now and then whether it shall go on.
#pragma once

#include <cstddef>
#include <functional>

namespace hitpipe::host {

/// While it lives, look() of this thread calls `look`, which throws to end the work.
class Watch {
 public:
  explicit Watch(std::function<void()> look);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  std::function<void()> look_;
  Watch* before_;
  friend void look();
};

/// Asks the thread's innermost Watch, if there is one. Loops of many calls (parallel.hpp) do so before each call.
void look();

/// The same for short calls: asks before call 0, 1024, ...
inline void look(std::size_t call) {
  if (call % 1024 == 0) look();
}

}  // namespace hitpipe::host
