// Where the tools of one implementation work: a folder that goes away, and one that keeps what is whole.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/files.hpp"
#include "sim/model/tool.hpp"

namespace hitpipe::sim {

class Workbench {
 public:
  /// Makes the folder that keeps things. Throws as host::make_folder() does.
  explicit Workbench(std::filesystem::path kept);

  /// Writes a file for the tools.
  void put(const host::File& file) const;
  /// Copies a file that a tool has written to the folder that stays.
  void keep(const std::string& name) const;
  /// put() and keep().
  void put_and_keep(const host::File& file) const;
  /// Throws std::runtime_error, one line, when the file is not there.
  [[nodiscard]] std::string read(const std::string& name) const;

  /// Runs a tool and keeps what it prints as `log`.
  [[nodiscard]] host::Outcome try_run(const Tool& tool, const std::vector<std::string>& arguments,
                                      const std::string& log) const;
  /// The same. Throws std::runtime_error, one line that names the log, when the tool fails. Returns what it
  /// printed.
  std::string run(const Tool& tool, const std::vector<std::string>& arguments, const std::string& log) const;

  [[nodiscard]] const std::filesystem::path& kept() const { return kept_; }

 private:
  std::filesystem::path kept_;
  host::ScratchFolder scratch_;
  std::filesystem::path work_;  ///< named as the folder that stays, so that paths in scripts hold in both
};

/// Puts a value in the place of each "{name}".
[[nodiscard]] inline std::string filled_in(
    std::string text, const std::vector<std::pair<std::string_view, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string place = "{" + std::string(name) + "}";
    for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += value.size())
      text.replace(at, place.size(), value);
  }
  return text;
}

}  // namespace hitpipe::sim
