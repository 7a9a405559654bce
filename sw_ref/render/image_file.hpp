// Image files, through OpenImageIO. Pixels go row by row from the top. Errors are std::runtime_error of one
// line that names the file.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// Writes linear colours: .png as 8-bit sRGB, .exr as linear half floats. The file appears whole or not at
/// all: it is written under another name and then renamed. Throws for an unknown extension, a file that
/// cannot be written, or a size that does not match `linear`.
void write_image(const std::filesystem::path& file, int width, int height,
                 const std::vector<glm::vec3>& linear);

/// Throws as write_image() would for this place. Writes nothing.
void check_image_place(const std::filesystem::path& file);

/// The values at the two ends of a colour map.
struct MapScale {
  float low = 0.0F;
  float high = 1.0F;
};

/// The scale from the least to the greatest finite value; {0, 0} if there is none.
[[nodiscard]] MapScale scale_of(std::span<const float> values);

/// Writes one number per pixel: in .exr as unchanged 32-bit floats, in .png as colours of viridis() between
/// the ends of the scale, black if a value is not finite. Otherwise as write_image().
void write_map(const std::filesystem::path& file, int width, int height, std::span<const float> values,
               const MapScale& scale);

/// A stored image with all its channels.
struct StoredImage {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float>
      values;  ///< by pixel, then channel; integer codes are divided by the largest code, into [0, 1]
};

/// Reads any format of OpenImageIO. Throws for a file that is missing or damaged, or has more than 2^28
/// pixels or 64 channels.
[[nodiscard]] StoredImage read_image(const std::filesystem::path& file);

}  // namespace hitpipe::ref
