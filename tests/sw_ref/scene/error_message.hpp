// The text of the exception that a call throws, so that a test can compare all of it.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace hitpipe::ref {

template <class Call>
std::string error_message(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace hitpipe::ref
