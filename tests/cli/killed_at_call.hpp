// Kills the program where it changes files.
#pragma once

#include <string>

#include "tests/cli/program.hpp"

namespace hitpipe::cli {

/// With these the program is killed (SIGKILL) at a call that changes files, counted from 1. kill_at_call.cpp
/// says which calls are counted.
inline Variables killed_at_call(int call) {
  return {{"LD_PRELOAD", HITPIPE_KILL_AT_CALL},
          {"HITPIPE_KILL_AT_CALL", std::to_string(call)},
          {"ASAN_OPTIONS", "verify_asan_link_order=0"}};
}

}  // namespace hitpipe::cli
