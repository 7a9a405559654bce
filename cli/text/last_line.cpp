#include "cli/text/last_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace hitpipe::cli {

namespace {

/// On a terminal it takes the place of the progress, which may be there.
std::string line_of(const std::string& text) {
  return fmt::format("{}hitpipe: stopped; {}\n", isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "", text);
}

}  // namespace

LastLine::LastLine(const std::string& text) : at_ending_({.say = line_of(text)}) {}

}  // namespace hitpipe::cli
