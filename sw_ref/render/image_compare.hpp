// How much two images differ.
#pragma once

#include <cstdint>
#include <vector>

#include "sw_ref/render/image_file.hpp"

namespace hitpipe::ref {

/// Differences over all channels, in the images' own values. Equal values differ by 0, also infinities and
/// NaN. A number and a NaN, or a number and an infinity, differ by infinity.
struct ImageDifference {
  std::uint64_t pixels = 0;
  std::uint64_t different_pixels = 0;  ///< they differ by more than the tolerance in some channel
  double largest = 0.0;
  double mean = 0.0;
  double psnr_db = 0.0;          ///< peak 1 over the root of the mean square; infinite for equal images
  std::vector<float> per_pixel;  ///< the largest of the channels
};

/// Throws std::runtime_error, one line, when the sizes or the numbers of channels differ. tolerance >= 0.
[[nodiscard]] ImageDifference compare_images(const StoredImage& a, const StoredImage& b, double tolerance);

}  // namespace hitpipe::ref
