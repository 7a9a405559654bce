// A call of the library that Python waits for.
#pragma once

#include <optional>

#include <pybind11/pybind11.h>

#include "hitpipe/ref.hpp"

namespace hitpipe::python {

/// While it lives, other threads have the interpreter. In the main thread, the only one that gets signals, a signal
/// whose handler raises ends the call: check() throws, and what was raised is Python's error.
class Working {
 public:
  Working() {
    if (in_main_thread()) stop_.emplace(signal_raised);
    others_run_.emplace();
  }

 private:
  static bool in_main_thread() {
    const pybind11::object main = pybind11::module_::import("threading").attr("main_thread")();
    return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
  }
  static bool signal_raised() {
    const pybind11::gil_scoped_acquire interpreter;
    return PyErr_CheckSignals() != 0;
  }

  std::optional<StopWhen> stop_;
  std::optional<pybind11::gil_scoped_release> others_run_;
};

}  // namespace hitpipe::python
