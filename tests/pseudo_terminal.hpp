// For tests that need a pseudo-terminal: a root without /dev/pts has none.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

namespace hitpipe {

/// Asks the system itself, so that a fault in host::SerialPort fails a test and does not skip it.
inline bool has_pseudo_terminal() {
  const int ours = posix_openpt(O_RDWR | O_NOCTTY);
  if (ours < 0) return false;
  const char* name = grantpt(ours) == 0 && unlockpt(ours) == 0 ? ptsname(ours) : nullptr;
  const int theirs = name != nullptr ? open(name, O_RDWR | O_NOCTTY) : -1;
  for (const int end : {ours, theirs})
    if (end >= 0) close(end);
  return theirs >= 0;
}

}  // namespace hitpipe

/// The first line of such a test.
#define SKIP_WITHOUT_PSEUDO_TERMINAL() \
  if (!hitpipe::has_pseudo_terminal()) GTEST_SKIP() << "no pseudo-terminal can be had: is /dev/pts mounted?"
