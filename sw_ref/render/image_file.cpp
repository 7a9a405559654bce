#include "sw_ref/render/image_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

namespace hitpipe::ref {
namespace {

[[noreturn]] void reject(const std::string& reason) {
  throw std::runtime_error(reason);
}

/// IEC 61966-2-1: 8-bit code of a linear value, rounded to nearest; NaN becomes 0.
std::uint8_t srgb(float linear) {
  const float x = linear > 0.0F ? std::min(linear, 1.0F) : 0.0F;
  const float encoded = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * encoded));
}

/// The bytes of the file. They are made in memory because OpenImageIO's PNG writer reports success on a full
/// disk.
std::vector<unsigned char> encode(const std::string& format, int width, int height,
                                  const std::vector<glm::vec3>& linear) {
  const bool is_png = format == "png";
  const auto output = OIIO::ImageOutput::create(format);
  OIIO::Filesystem::IOVecOutput bytes;
  if (!output || !output->supports("ioproxy") || !output->set_ioproxy(&bytes))
    reject(fmt::format("this OpenImageIO cannot write .{}; use one that can", format));
  OIIO::ImageSpec spec(width, height, 3, is_png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::HALF);
  spec.attribute("oiio:ColorSpace", is_png ? "sRGB" : "Linear");
  std::vector<std::uint8_t> codes;
  if (is_png) {
    codes.reserve(3 * linear.size());
    for (const glm::vec3& colour : linear)
      codes.insert(codes.end(), {srgb(colour.x), srgb(colour.y), srgb(colour.z)});
  } else {
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // else the time of writing: equal images must be equal files
  }
  const std::string name = "image." + format;
  if (!output->open(name, spec) ||
      !(is_png ? output->write_image(OIIO::TypeDesc::UINT8, codes.data())
               : output->write_image(OIIO::TypeDesc::FLOAT, linear.data())) ||
      !output->close())
    reject(fmt::format("OpenImageIO cannot encode it; allowed are images that fit .{} ({})", format,
                       output->geterror()));
  return bytes.buffer();
}

void write_beside(const std::filesystem::path& file, int width, int height,
                  const std::vector<glm::vec3>& linear) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".png" && extension != ".exr")
    reject(fmt::format("unknown extension \"{}\"; allowed are .png and .exr", extension));
  if (width < 1 || height < 1 ||
      linear.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    reject(fmt::format("{} pixels do not fill {} x {}; every pixel of an image of at least 1 x 1 is needed",
                       linear.size(), width, height));
  const std::filesystem::path folder =
      file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder))
    reject(fmt::format("no folder \"{}\"; create it first", folder.string()));
  if (std::filesystem::is_directory(file)) reject("is a folder; give the name of a file");
  const std::vector<unsigned char> bytes = encode(extension.substr(1), width, height, linear);
  std::filesystem::path partial = file;
  partial += fmt::format(".{}.partial", ::getpid());
  try {
    std::ofstream out(partial, std::ios::binary);
    if (!out)
      reject(fmt::format("no file can be made in folder \"{}\"; choose one with write permission",
                         folder.string()));
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out)
      reject(fmt::format("its {} bytes cannot be written; make room or choose another folder", bytes.size()));
    std::filesystem::rename(partial, file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw;
  }
}

}  // namespace

void write_image(const std::filesystem::path& file, int width, int height,
                 const std::vector<glm::vec3>& linear) {
  try {
    write_beside(file, width, height, linear);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("image file \"{}\": {}", file.string(), error.what()));
  }
}

}  // namespace hitpipe::ref
