// How readers and writers of files refuse: with one line that says what is wrong, where, and what is allowed.
#pragma once

#include <stdexcept>
#include <string>

namespace hitpipe::ref {

[[noreturn]] inline void reject(const std::string& reason) {
  throw std::runtime_error(reason);
}

}  // namespace hitpipe::ref
