// What the program says when a signal such as that of Ctrl-C ends it.
#pragma once

#include <string>

#include "host/ending.hpp"

namespace hitpipe::cli {

/// As long as it exists, a signal that ends the program prints "hitpipe: stopped; TEXT" on standard error.
class LastLine {
 public:
  explicit LastLine(const std::string& text);

 private:
  host::AtEnding at_ending_;
};

}  // namespace hitpipe::cli
