#include "host/talk.hpp"

#include <atomic>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace hitpipe::host {

namespace {

std::atomic<Talk> chosen = Talk::usual;

void say(const std::string& text) {
  fmt::print(stderr, "{}hitpipe: {}\n", isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "", text);
}

}  // namespace

void set_talk(Talk talk) {
  chosen = talk;
}

Talk talk() {
  return chosen;
}

void note(const std::string& text) {
  if (talk() != Talk::quiet) say(text);
}

void note_step(const std::string& text) {
  if (talk() == Talk::verbose) say(text);
}

}  // namespace hitpipe::host
