#include "rtl_gen/emit/unit_folder.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "rtl_gen/emit/manifest.hpp"

namespace hitpipe::rtl {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> names_of(const std::vector<host::File>& files) {
  std::vector<std::string> all;
  for (const host::File& file : files) all.push_back(file.name);
  return all;
}

/// What a manifest in the folder lists; nothing when the file is not there or is no manifest.
std::vector<std::string> listed_in(const fs::path& manifest) {
  const std::optional<std::string> text = host::contents_of(manifest);
  if (!text) return {};
  try {
    return head_of(*text).files;
  } catch (const std::runtime_error&) {
    return {};
  }
}

/// Whether the name leads to a regular file in the folder. A link on the way could lead out of it.
bool is_own_file(const fs::path& folder, const fs::path& name) {
  if (name.empty() || name.is_absolute()) return false;
  fs::path at = folder;
  std::error_code ignored;
  for (const fs::path& part : name) {
    if (part == "..") return false;
    if (at != folder && fs::symlink_status(at, ignored).type() != fs::file_type::directory) return false;
    at /= part;
  }
  return fs::symlink_status(at, ignored).type() == fs::file_type::regular;
}

void remove_file(const fs::path& folder, const fs::path& name) {
  std::error_code ignored;  // a file that stays does no harm
  fs::remove(folder / name, ignored);
  for (fs::path parent = name.parent_path(); !parent.empty(); parent = parent.parent_path())
    if (!fs::remove(folder / parent, ignored)) break;  // it is not empty
}

/// What the manifests of other units in the folder list.
std::set<std::string> files_of_others(const fs::path& folder, const std::string& own_manifest) {
  std::set<std::string> all;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".json" || file.filename() == own_manifest) continue;
    for (std::string& name : listed_in(file)) all.insert(std::move(name));
  }
  return all;
}

}  // namespace

UnitFiles files_and_drawings(const EmittedDesign& emitted) {
  const std::optional<std::vector<host::File>> drawings = draw(emitted.schematics);
  return {emitted.files(drawings.value_or(std::vector<host::File>{})), drawings.has_value()};
}

UnitFiles write_unit(const fs::path& folder, const EmittedDesign& emitted) {
  UnitFiles unit = files_and_drawings(emitted);
  const std::string manifest = emitted.module + ".json";
  std::vector<std::string> stale = listed_in(folder / manifest);
  host::write_files(folder, unit.files);
  const std::vector<std::string> written = names_of(unit.files);
  std::erase_if(stale, [&](const std::string& name) {
    return std::find(written.begin(), written.end(), name) != written.end() || !is_own_file(folder, name);
  });
  if (stale.empty()) return unit;
  const std::set<std::string> others = files_of_others(folder, manifest);
  for (const std::string& name : stale)
    if (!others.contains(name)) remove_file(folder, name);
  return unit;
}

}  // namespace hitpipe::rtl
