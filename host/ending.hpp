// What SIGINT, SIGTERM and SIGHUP do before they end the program: they end its children, remove its temporary
// files, and say how the work goes on.
#pragma once

#include <csignal>
#include <list>
#include <string>

#include <sys/types.h>

namespace hitpipe::host {

/// Makes the three signals do so, except one that the program ignores or handles itself. May be called again.
void end_by_signals_cleanly();

/// While one exists, none of the three signals ends the program, in whatever thread it comes. Once a signal
/// is ending the program, the constructor does not return. A thread has one at a time.
class HeldSignals {
 public:
  HeldSignals();
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// The signals that this thread blocked before.
  [[nodiscard]] const sigset_t& before() const { return before_; }

 private:
  sigset_t before_{};
};

/// What is to be done when a signal ends the program, as long as this exists. It is done only by the process
/// that has asked for it, not by one that was forked from it.
class AtEnding {
 public:
  struct Act {
    pid_t end_group = 0;      ///< a child that leads a group: the signal is sent to all of it
    std::string remove = {};  ///< a file, or a folder with all that is in it
    std::string say = {};     ///< a line for standard error
  };

  explicit AtEnding(Act act) : AtEnding(HeldSignals(), std::move(act)) {}
  AtEnding(const HeldSignals& held, Act act);
  ~AtEnding();
  AtEnding(const AtEnding&) = delete;
  AtEnding& operator=(const AtEnding&) = delete;

  struct Entry {
    pid_t owner;
    Act act;
  };

 private:
  std::list<Entry>::iterator entry_;
};

}  // namespace hitpipe::host
