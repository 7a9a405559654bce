// Image files, through OpenImageIO. Pixels go row by row from the top. Errors are std::runtime_error of one
// line that names the file.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// Writes linear colours: .png as 8-bit sRGB, .exr as linear half floats. The file appears whole or not at
/// all: it is written beside its place under another name, then renamed. Throws for an unknown extension, a
/// place that cannot be written, or a size that does not match `linear`.
void write_image(const std::filesystem::path& file, int width, int height,
                 const std::vector<glm::vec3>& linear);

/// What the two ends of a colour map stand for.
struct MapScale {
  float low = 0.0F;
  float high = 1.0F;
};

/// The scale from the least to the greatest finite value; {0, 0} when there is none.
[[nodiscard]] MapScale scale_of(std::span<const float> values);

/// Writes one number per pixel: .exr as 32-bit floats as they are, .png in the colours of viridis() between
/// the ends of the scale, black where a value is not finite. Otherwise as write_image().
void write_map(const std::filesystem::path& file, int width, int height, std::span<const float> values,
               const MapScale& scale);

/// An image as it is stored, with all its channels.
struct StoredImage {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float>
      values;  ///< by pixel, then channel; integer codes are divided by the largest, so in [0, 1]
};

/// Any format that OpenImageIO reads. Throws for a file that is missing or damaged, and for more than 2^28
/// pixels or 64 channels.
[[nodiscard]] StoredImage read_image(const std::filesystem::path& file);

}  // namespace hitpipe::ref
