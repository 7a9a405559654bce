#include "host/scratch_folder.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <stdlib.h>

namespace hitpipe::host {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const std::string& prefix) : ScratchFolder(fs::temp_directory_path(), prefix) {}

ScratchFolder::ScratchFolder(const fs::path& parent, const std::string& prefix) {
  std::string name = (parent / (prefix + "XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(fmt::format("{}: cannot create a folder in it: {}", parent.string(),
                                         std::generic_category().message(errno)));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace hitpipe::host
