#include "sim/operands/ray_list.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "host/files.hpp"
#include "host/text.hpp"
#include "sim/operands/number_file.hpp"
#include "sw_ref/render/camera.hpp"

namespace hitpipe::sim {

namespace {

/// Where a double still has half of binary32's bits for the point at which a ray enters the cube.
constexpr double farthest = 0x1p20;

/// A ray as the file says it.
struct OwnRay {
  glm::dvec3 origin{0.0};
  glm::vec3 direction{0.0F};
  double length = ref::Ray::infinite;
  bool any = false;
};

using Reject = std::function<void(const std::string& why)>;  ///< throws

AskedRay placed(const OwnRay& own, const ref::Normalisation& to_cube, const Reject& reject) {
  for (int axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    if (!std::isfinite(own.origin[axis]))
      reject(fmt::format("o{} is {}, which is no place", name, own.origin[axis]));
    if (!std::isfinite(own.direction[axis]))
      reject(fmt::format("d{} is {} in binary32; a direction may have any length, but a finite one", name,
                         own.direction[axis]));
  }
  if (own.direction == glm::vec3(0.0F))
    reject("the direction is (0, 0, 0) in binary32; one component must differ from 0");
  if (std::isnan(own.length) || own.length < 0.0)
    reject(fmt::format("length {}; allowed is 0 or more, or inf for a ray without an end", own.length));
  const glm::dvec3 start = to_cube.to_cube(own.origin);
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(start[axis]) <= farthest))
      reject(fmt::format("o{} {} lies more than 2^20 times as far away as the scene's cube is wide",
                         "xyz"[axis], own.origin[axis]));
  if (to_cube.chosen)
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(start[axis]) > 1.0)
        reject(fmt::format("o{} {} lies outside the cube; a chosen cube must hold all origins", "xyz"[axis],
                           own.origin[axis]));
  // The direction stays as it is, so t grows as the scene does.
  const double length = own.length * to_cube.scale;
  if (std::isfinite(own.length) && std::isinf(static_cast<float>(length)))
    reject(fmt::format("length {} is beyond binary32; for a ray without an end write inf", own.length));
  return {ref::ray_in_cube(start, own.direction, length), own.any ? ref::Query::any : ref::Query::closest,
          ref::start_in_cube(start, own.direction)};
}

std::vector<AskedRay> read_csv(const std::string& file, const ref::Normalisation& to_cube) {
  constexpr std::size_t length_column = 6;
  constexpr std::size_t any_column = 7;
  NumberFile lines(file, {"ox", "oy", "oz", "dx", "dy", "dz"}, {"length", "any"});
  std::array<std::string_view, any_column + 1> words;
  std::vector<AskedRay> rays;
  while (const std::optional<NumberLine> line = lines.next()) {
    lines.words(*line, words);
    const auto number = [&](std::size_t column) {
      const std::optional<double> value = read_double(words[column]);
      if (!value)
        lines.reject(*line, fmt::format("{} is \"{}\", which is no number", lines.column(column),
                                        host::shortened(words[column])));
      return *value;
    };
    OwnRay own;
    for (int axis = 0; axis < 3; ++axis) {
      const auto column = static_cast<std::size_t>(axis);
      own.origin[axis] = number(column);
      static_cast<void>(number(column + 3));
      own.direction[axis] = nearest_binary32(words[column + 3]);
    }
    const std::string_view length = words[length_column];
    if (!length.empty() && length != "inf" && length != "+inf") own.length = number(length_column);
    const std::string_view any = words[any_column];
    if (!any.empty() && any != "0" && any != "1")
      lines.reject(*line, fmt::format("any is \"{}\"; allowed are 0, the closest hit, and 1, any hit",
                                      host::shortened(any)));
    own.any = any == "1";
    rays.push_back(placed(own, to_cube, [&](const std::string& why) { lines.reject(*line, why); }));
  }
  return rays;
}

/// Little-endian.
template <class Word>
Word word_at(std::string_view bytes, std::size_t place) {
  Word word = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i)
    word |= static_cast<Word>(static_cast<unsigned char>(bytes[place + i])) << (8 * i);
  return word;
}

float float_at(std::string_view bytes, std::size_t place) {
  return std::bit_cast<float>(word_at<std::uint32_t>(bytes, place));
}

std::vector<AskedRay> read_binary(const std::string& file, const ref::Normalisation& to_cube) {
  constexpr std::string_view magic = "hprays1\n";
  constexpr std::size_t head = 16;
  constexpr std::size_t ray_bytes = 32;
  const std::string bytes = host::read_file(file);
  if (!bytes.starts_with(magic) || bytes.size() < head)
    throw std::runtime_error(
        fmt::format("{}: does not begin with the 8 bytes hprays1\\n and a count; a file of CSV needs a name "
                    "that does not end "
                    "in .bin or .rays",
                    file));
  const auto count = word_at<std::uint64_t>(bytes, magic.size());
  if (const std::size_t rest = bytes.size() - head; rest % ray_bytes != 0 || rest / ray_bytes != count)
    throw std::runtime_error(
        fmt::format("{}: announces {} rays of {} bytes, but {} bytes follow", file, count, ray_bytes, rest));
  std::vector<AskedRay> rays;
  rays.reserve(count);
  for (std::size_t ray = 0; ray < count; ++ray) {
    const Reject reject = [&](const std::string& why) {
      throw std::runtime_error(fmt::format("{}: ray {}: {}", file, ray + 1, why));
    };
    const std::size_t at = head + ray * ray_bytes;
    OwnRay own;
    for (int axis = 0; axis < 3; ++axis) {
      own.origin[axis] = double{float_at(bytes, at + 4 * static_cast<std::size_t>(axis))};
      own.direction[axis] = float_at(bytes, at + 12 + 4 * static_cast<std::size_t>(axis));
    }
    own.length = double{float_at(bytes, at + 24)};
    const auto any = word_at<std::uint32_t>(bytes, at + 28);
    if (any > 1) reject(fmt::format("any is {}; allowed are 0, the closest hit, and 1, any hit", any));
    own.any = any == 1;
    rays.push_back(placed(own, to_cube, reject));
  }
  return rays;
}

}  // namespace

std::vector<AskedRay> read_ray_list(const std::string& file, const ref::Normalisation& to_cube) {
  const std::string extension = std::filesystem::path(file).extension();
  const bool binary = extension == ".bin" || extension == ".rays";
  std::vector<AskedRay> rays = binary ? read_binary(file, to_cube) : read_csv(file, to_cube);
  if (rays.empty()) throw std::runtime_error(fmt::format("{}: holds no ray", file));
  return rays;
}

}  // namespace hitpipe::sim
