#include <dlfcn.h>
#include <fmt/format.h>

#include "host/reject.hpp"
#include "sw_ref/render/image_codec.hpp"

namespace hitpipe::ref {

namespace {

namespace fs = std::filesystem;

/// Beside an installed program, otherwise in the build folder that the program is in. If it is in neither, where
/// an installation should have it.
fs::path module_file() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path().parent_path() / HITPIPE_IMAGES_INSTALLED;
  if (fs::exists(installed, ignored)) return installed;
  for (fs::path folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    if (fs::exists(folder / HITPIPE_IMAGES_BUILT, ignored)) return folder / HITPIPE_IMAGES_BUILT;
  return installed;
}

/// Null says nothing: the last call was good, or another thread asked.
const char* loader_error() {
  const char* const error = dlerror();
  return error != nullptr ? error : "no reason is given";
}

const ImageCodec* load() {
  const fs::path file = module_file();
  if (std::error_code ignored; !fs::exists(file, ignored))
    reject(fmt::format("images need {}, which is not there; a build makes it if OpenImageIO is installed",
                       file.string()));
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr)
    reject(fmt::format("images need a library that cannot be loaded: {}", loader_error()));
  const auto entry = reinterpret_cast<decltype(&hitpipe_image_codec)>(dlsym(module, "hitpipe_image_codec"));
  if (entry == nullptr) reject(fmt::format("images need another {}: {}", file.string(), loader_error()));
  return entry();
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec* const codec = load();
  return *codec;
}

}  // namespace hitpipe::ref
