// The text of the exception that a call ends with, so that a test can match all of it, and its type.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace hitpipe {

template <class Error, class Call>
std::string message_of(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const Error& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("an exception of another type: ") + error.what();
  }
  return "no exception";
}

}  // namespace hitpipe
