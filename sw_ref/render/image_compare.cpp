#include "sw_ref/render/image_compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::ref {
namespace {

double distance(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double d = std::abs(double{a} - double{b});
  return std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
}

}  // namespace

ImageDifference compare_images(const StoredImage& a, const StoredImage& b, double tolerance) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    throw std::runtime_error(
        fmt::format("{} x {} pixels of {} channels and {} x {} of {}; images must be alike in all three",
                    a.width, a.height, a.channels, b.width, b.height, b.channels));
  ImageDifference difference;
  const auto channels = static_cast<std::size_t>(a.channels);
  difference.pixels = a.values.size() / channels;
  difference.per_pixel.reserve(difference.pixels);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t pixel = 0; pixel < difference.pixels; ++pixel) {
    double largest = 0.0;
    for (std::size_t i = pixel * channels; i < (pixel + 1) * channels; ++i) {
      const double d = distance(a.values[i], b.values[i]);
      largest = std::max(largest, d);
      sum += d;
      squares += d * d;
    }
    difference.different_pixels += largest > tolerance ? 1 : 0;
    difference.largest = std::max(difference.largest, largest);
    difference.per_pixel.push_back(static_cast<float>(largest));
  }
  const auto values = static_cast<double>(a.values.size());
  difference.mean = sum / values;
  difference.psnr_db = -10.0 * std::log10(squares / values);
  return difference;
}

}  // namespace hitpipe::ref
