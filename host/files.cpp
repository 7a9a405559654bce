#include "host/files.hpp"

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace hitpipe::host {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw std::runtime_error(
      fmt::format("{}: cannot {}: {}", path.string(), what, std::generic_category().message(error)));
}

/// Writes files under other names and renames them at the end. Removes the files that it did not rename.
class Replacement {
 public:
  Replacement() = default;
  ~Replacement() {
    std::error_code ignored;
    for (const Written& each : written_) fs::remove(each.aside, ignored);
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  void write(const fs::path& place, std::string_view contents) {
    const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
    make_folder(folder);
    // No rename may fail half-way, and none may replace a device such as /dev/null.
    std::error_code ignored;
    if (fs::is_directory(place, ignored)) fail(place, "write the file", EISDIR);
    if (fs::exists(place, ignored) && !fs::is_regular_file(place, ignored))
      throw std::runtime_error(fmt::format("{}: is not a file that can be replaced", place.string()));
    written_.push_back({folder / fmt::format(".{}.{}", place.filename().string(), getpid()), place});
    std::FILE* const file = std::fopen(written_.back().aside.c_str(), "wbe");
    if (file == nullptr) fail(place, "write the file", errno);
    const bool taken = std::fwrite(contents.data(), 1, contents.size(), file) == contents.size();
    const bool closed = std::fclose(file) == 0;
    if (!taken || !closed) fail(place, "write the file", errno);
  }

  void rename() {
    std::error_code error;
    for (const Written& each : written_) {
      fs::rename(each.aside, each.place, error);
      if (error) fail(each.place, "write the file", error.value());
    }
    written_.clear();
  }

 private:
  struct Written {
    fs::path aside;
    fs::path place;
  };
  std::vector<Written> written_;
};

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, "create the folder", error.value());
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail(folder, "write to the folder", errno);
}

void write_files(const fs::path& folder, const std::vector<File>& files) {
  Replacement replacement;
  for (const File& file : files) replacement.write(folder / file.name, file.contents);
  replacement.rename();
}

void write_file(const fs::path& file, std::string_view contents) {
  Replacement replacement;
  replacement.write(file, contents);
  replacement.rename();
}

}  // namespace hitpipe::host
