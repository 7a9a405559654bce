// Reads and writes image files. It is a module that the program loads only when it needs one: OpenImageIO
// brings hundreds of libraries, and loading them takes longer than most commands.
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

/// Loads the module at the first call. Throws std::runtime_error if it cannot be loaded.
[[nodiscard]] const ImageCodec& image_codec();

/// The entry point of the module.
extern "C" const ImageCodec* hitpipe_image_codec();

}  // namespace hitpipe::ref
