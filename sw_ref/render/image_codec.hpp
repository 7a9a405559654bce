// What reads and writes image files, kept out of the program until one is read or written: OpenImageIO brings
// hundreds of libraries, whose loading takes longer than most commands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sw_ref/render/image_file.hpp"

namespace hitpipe::ref {

/// Pixels as a file holds them.
struct EncodedPixels {
  std::vector<std::uint8_t> codes;  ///< .png: sRGB
  std::vector<float> values;        ///< .exr
  int channels = 3;
  bool full_floats = false;  ///< .exr of 32 bits, else 16
};

/// Throws std::runtime_error, one line.
class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  /// The bytes of a file of the format, "png" or "exr".
  [[nodiscard]] virtual std::vector<unsigned char> encode(const std::string& format, int width, int height,
                                                          const EncodedPixels& image) const = 0;
  [[nodiscard]] virtual StoredImage read(const std::filesystem::path& file) const = 0;
};

/// Loaded when first asked for. Throws std::runtime_error when it cannot be.
[[nodiscard]] const ImageCodec& image_codec();

/// The entry point of the module.
extern "C" const ImageCodec* hitpipe_image_codec();

}  // namespace hitpipe::ref
