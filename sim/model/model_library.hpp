// Verilog as a shared library. Verilator makes it at run time, and a cache keeps it by its content.
#pragma once

#include <filesystem>
#include <string>

#include "sim/model/pins.hpp"

namespace hitpipe::sim {

/// $HITPIPE_CACHE, else $XDG_CACHE_HOME/hitpipe, else ~/.cache/hitpipe; without a home a folder of the user in
/// $TMPDIR or /tmp.
[[nodiscard]] std::filesystem::path default_cache();

struct ModelSources {
  std::string module;  ///< the top of the Verilog
  std::string verilog;
  std::string wrapper;  ///< C++ with the entry points; it includes the Verilated class and pins.hpp
};

class ModelLibrary {
 public:
  /// Verilator and the C++ compiler build it unless the cache already holds a build of these sources. Two
  /// processes may do this at once: each builds in a folder of its own, and the first to finish is kept.
  /// $VERILATOR and $CXX name other programs than `verilator` and `clang++` (`c++` where that cannot
  /// compile); they may hold arguments ("env g++"). $CXXFLAGS are more options of the compiler. Throws
  /// std::runtime_error, one line, when Verilator or the compiler is missing or fails (the line says where
  /// the log is), when the cache cannot be written, or when an entry cannot be loaded.
  ModelLibrary(const ModelSources& model, const std::filesystem::path& cache);
  ~ModelLibrary();
  ModelLibrary(const ModelLibrary&) = delete;
  ModelLibrary& operator=(const ModelLibrary&) = delete;

  /// An instance of the model, made and ended by the wrapper's hitpipe_create and hitpipe_destroy.
  [[nodiscard]] void* create() const;
  void destroy(void* model) const { destroy_(model); }

  /// Throws std::runtime_error, one line, when the library does not have it.
  template <class Function>
  [[nodiscard]] Function entry_point(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }

 private:
  [[nodiscard]] void* symbol(const char* name) const;
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  void* library_ = nullptr;
  CreateModel create_ = nullptr;
  DestroyModel destroy_ = nullptr;
};

}  // namespace hitpipe::sim
