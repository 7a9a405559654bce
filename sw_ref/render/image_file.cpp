#include "sw_ref/render/image_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include <boost/crc.hpp>
#include <fmt/format.h>

#include "host/files.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"
#include "sw_ref/render/colour_map.hpp"
#include "sw_ref/render/image_codec.hpp"

namespace hitpipe::ref {
namespace {

/// Big-endian.
std::uint32_t number(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

bool filled(std::ifstream& in, char* bytes, std::size_t count) {
  return static_cast<bool>(in.read(bytes, static_cast<std::streamsize>(count)));
}

/// Checks signature, length and checksum of each chunk up to IEND (ISO/IEC 15948, 5), because libpng itself writes to
/// standard error about a damaged file. Ignores a file without the signature; other readers check it.
void check_png(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 8> head{};
  if (!filled(in, head.data(), head.size()) || std::string(head.data(), 8) != "\x89PNG\r\n\x1a\n") return;
  const std::uint64_t size = std::filesystem::file_size(file);
  const auto reject = [](const std::string& why) {
    throw std::runtime_error(fmt::format("a damaged PNG, {}; give a whole one", why));
  };
  std::vector<char> chunk;  // name, contents, checksum
  while (filled(in, head.data(), 4)) {
    const std::uint64_t length = number(head.data());
    if (length + 8 > size - static_cast<std::uint64_t>(in.tellg())) reject("it ends within a chunk");
    chunk.resize(length + 8);
    if (!filled(in, chunk.data(), chunk.size())) reject("it cannot be read to its end");
    boost::crc_32_type sum;
    sum.process_bytes(chunk.data(), length + 4);
    if (sum.checksum() != number(chunk.data() + length + 4)) reject("a checksum is wrong");
    if (std::string(chunk.data(), 4) == "IEND") return;
  }
  reject("its end is missing");
}

/// IEC 61966-2-1: 8-bit code of a linear value, rounded to nearest; NaN becomes 0.
std::uint8_t srgb(float linear) {
  const float x = linear > 0.0F ? std::min(linear, 1.0F) : 0.0F;
  const float encoded = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255.0F * encoded));
}

/// "png" or "exr".
std::string format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".png" && extension != ".exr")
    reject(fmt::format("unknown extension \"{}\"; allowed are .png and .exr", host::shortened(extension)));
  return extension.substr(1);
}

void check_size(int width, int height, std::size_t pixels) {
  if (width < 1 || height < 1 || pixels != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    reject(fmt::format("{} pixels do not fill {} x {}; every pixel of an image of at least 1 x 1 is needed",
                       pixels, width, height));
}

void check_place(const std::filesystem::path& file) {
  static_cast<void>(format_of(file));
  const std::filesystem::path folder =
      file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder))
    reject(fmt::format("no folder \"{}\"; create it first", folder.string()));
  if (std::filesystem::is_directory(file)) reject("is a folder; give the name of a file");
}

/// The file's bytes.
std::vector<unsigned char> encoded(const std::filesystem::path& file, int width, int height,
                                   const EncodedPixels& image) {
  check_place(file);
  return image_codec().encode(format_of(file), width, height, image);
}

void write(const std::filesystem::path& file, const std::vector<unsigned char>& bytes) {
  host::write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// Runs `what` and names the file in its errors, in one line.
template <class What>
auto naming(const std::filesystem::path& file, const What& what) {
  try {
    return what();
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("image file \"{}\": {}", file.string(), error.what()));
  }
}

StoredImage read(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) reject("no such file; check the name");
  if (std::filesystem::is_directory(file)) reject("is a folder; give the name of a file");
  check_png(file);
  return image_codec().read(file);
}

}  // namespace

void check_image_place(const std::filesystem::path& file) {
  naming(file, [&] { check_place(file); });
}

void write_image(const std::filesystem::path& file, int width, int height,
                 const std::vector<glm::vec3>& linear) {
  const std::vector<unsigned char> bytes = naming(file, [&] {
    const bool is_png = format_of(file) == "png";
    check_size(width, height, linear.size());
    EncodedPixels image;
    is_png ? image.codes.reserve(3 * linear.size()) : image.values.reserve(3 * linear.size());
    for (const glm::vec3& colour : linear) {
      for (int k = 0; k < 3; ++k) {
        if (is_png)
          image.codes.push_back(srgb(colour[k]));
        else
          image.values.push_back(colour[k]);
      }
    }
    return encoded(file, width, height, image);
  });
  write(file, bytes);
}

MapScale scale_of(std::span<const float> values) {
  MapScale scale{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    scale = {std::min(scale.low, value), std::max(scale.high, value)};
  }
  return scale.low <= scale.high ? scale : MapScale{0.0F, 0.0F};
}

void write_map(const std::filesystem::path& file, int width, int height, std::span<const float> values,
               const MapScale& scale) {
  const std::vector<unsigned char> bytes = naming(file, [&] {
    const bool is_png = format_of(file) == "png";
    check_size(width, height, values.size());
    EncodedPixels image;
    if (is_png) {
      const float size = scale.high > scale.low ? scale.high - scale.low : 1.0F;
      for (const float value : values) {
        const Srgb colour = viridis(std::isfinite(value) ? (value - scale.low) / size
                                                         : std::numeric_limits<float>::quiet_NaN());
        image.codes.insert(image.codes.end(), colour.begin(), colour.end());
      }
    } else {
      image.values.assign(values.begin(), values.end());
      image.channels = 1;
      image.full_floats = true;
    }
    return encoded(file, width, height, image);
  });
  write(file, bytes);
}

StoredImage read_image(const std::filesystem::path& file) {
  return naming(file, [&] { return read(file); });
}

}  // namespace hitpipe::ref
