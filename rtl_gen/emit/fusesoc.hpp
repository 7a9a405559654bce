// A FuseSoC core file (CAPI 2, flow API) of anything that is emitted. Paths are relative to the core file.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/component/library.hpp"

namespace hitpipe::rtl {

struct FuseSoc {
  struct Fileset {
    std::string name;
    std::string files;  ///< lines of YAML that say which, and of what type
  };
  /// `type` is of FuseSoC. What others include is not compiled by itself.
  struct File {
    std::string name, type;
    bool is_included = false;
  };
  struct Target {
    std::string name, description;
    std::vector<std::string> filesets;
    std::string top;
    std::string flow{}, options{};  ///< of Edalize; `options` is a map of YAML
  };

  std::string name;  ///< "ray_box:int_slabs"
  std::string description;
  std::vector<Fileset> filesets{};
  std::vector<Target> targets{};

  /// MODULE.v.
  void add_verilog(const std::string& fileset, const std::string& module);
  /// Sources, and a file of vectors in tb/, which is copied to where a simulator runs and looks for it.
  void add_test(const std::string& fileset, const std::vector<File>& sources, const std::string& vectors);

  /// Targets lint, sim (Icarus) and sim_verilator, and those of the library that synthesise. `defines` are
  /// words of both simulators' command lines.
  void add_lint(const std::vector<std::string>& sources, const std::string& top);
  void add_simulations(std::vector<std::string> sources, const std::string& testbench,
                       const std::string& defines = "");
  void add_harness(const std::vector<std::string>& sources, const std::string& top,
                   const std::string& defines = "");
  void add_synthesis(const Library& library, const std::vector<std::string>& sources, const std::string& top);

  [[nodiscard]] std::string text() const;
};

}  // namespace hitpipe::rtl
