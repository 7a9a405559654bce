// The text and type of the exception that a call throws, so that a test can compare all of it.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace hitpipe {

template <class Error = std::runtime_error, class Call>
std::string message_of(Call&& call) {
  try {
    try {
      std::forward<Call>(call)();
    } catch (const Error& error) {
      return error.what();
    }
  } catch (const std::exception& error) {
    return std::string("an exception of another type: ") + error.what();
  }
  return "no exception";
}

}  // namespace hitpipe
