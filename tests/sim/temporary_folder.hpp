// A temporary folder of one test. It is removed at the end with everything in it.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "host/files.hpp"

namespace hitpipe::sim {

class TemporaryFolder : public host::ScratchFolder {
 public:
  TemporaryFolder() : ScratchFolder("hitpipe-test-") {}

  /// Writes a file of the folder and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name, std::ios::binary) << text;
    return path() / name;
  }
  std::filesystem::path write_program(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = write(name, text);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
  }
};

}  // namespace hitpipe::sim
