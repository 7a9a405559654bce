// Stands in for Verilator in tests of the cache. It "compiles" any design into a model that never answers,
// within a fraction of a second. It notes every run, and can be slow or fail.
#pragma once

#include <filesystem>
#include <string>

#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim {

class StubVerilator {
 public:
  /// Sets $VERILATOR to itself as long as it exists.
  StubVerilator();

  void set_version(const std::string& version) { write("version", version); }
  /// How long a run takes, in seconds. The run is noted before.
  void set_seconds(const std::string& seconds) { write("seconds", seconds); }
  /// The exit code of a run. If it is not 0, the run prints "stub fails" and makes nothing.
  void set_exit_code(int code) { write("code", std::to_string(code)); }
  /// What --getenv VERILATOR_ROOT prints.
  void set_root(const std::string& root) { write("root", root); }

  /// Number of runs so far, without those for --version and --getenv.
  [[nodiscard]] int runs() const;
  [[nodiscard]] std::filesystem::path program() const { return folder_.path() / "verilator"; }

 private:
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text + "\n"); }

  TemporaryFolder folder_;
  EnvironmentValue variable_;
};

}  // namespace hitpipe::sim
