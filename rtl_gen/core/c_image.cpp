#include "rtl_gen/core/c_image.hpp"

#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hls/machines/block_kind.hpp"
#include "hls/machines/failure.hpp"

namespace hitpipe::rtl {

namespace {

constexpr std::string_view text_of_image = R"(
/* What an image says of itself. A point p of the mesh lies at (p - offset) scale in the image's cube. */
struct core_image {
  uint32_t coord_bits, levels, blocks, triangles;
  uint32_t missing; /* triangles of the mesh that the image lacks */
  uint32_t most_in_leaf; /* triangles of one leaf, at most */
  double offset[3], scale;
};

static inline double core_double(const uint8_t* bytes) {
  const uint64_t word = core_get(bytes, 8);
  double value;
  memcpy(&value, &word, sizeof value);
  return value;
}

/* FNV-1a, continued. */
static inline uint64_t core_hash(uint64_t hash, const uint8_t* bytes, uint64_t count) {
  for (uint64_t i = 0; i < count; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
  return hash;
}

/* Reads the header of an image that software can see. NULL: the core can trace it; else why not. */
static inline const char* core_read_image(struct core_image* image, const uint8_t* bytes, uint64_t size) {
  if (size < CORE_HEADER_BYTES || memcmp(bytes + 32, "hitpipe", 7) != 0) return "there is no image";
  if (bytes[39] != CORE_IMAGE_VERSION) return "the image has another version than the core's header";
  image->coord_bits = bytes[40];
  image->levels = bytes[41];
  image->blocks = (uint32_t)core_get(bytes + 44, 4);
  image->triangles = (uint32_t)core_get(bytes + 48, 4);
  image->missing = (uint32_t)core_get(bytes + 52, 4);
  image->most_in_leaf = bytes[42];
  for (int axis = 0; axis < 3; ++axis) image->offset[axis] = core_double(bytes + 64 + 8 * axis);
  image->scale = core_double(bytes + 96);
  if (image->coord_bits != CORE_COORD_BITS) return "the image has another grid than the core";
  if (image->levels > CORE_LEVELS) return "the image has more levels than the core";
  if (((uint64_t)image->blocks - 1) >> CORE_BLOCK_BITS != 0)
    return "the image has more blocks than the core can name";
  if (((uint64_t)image->triangles + image->missing) >> CORE_NUMBER_BITS != 0)
    return "the mesh has more triangles than the core has numbers for";
  if ((image->most_in_leaf + 1) >> CORE_LEAF_BITS != 0)
    return "the image has leaves with more triangles than the core can count";
  const uint64_t all = (uint64_t)image->blocks * CORE_BLOCK_BYTES;
  if (all > size || all < CORE_HEADER_BYTES) return "the image is cut";
  if (all % CORE_LINE_BYTES != 0) return "the image does not end where a line does";
  const uint64_t before = core_hash(0xcbf29ce484222325u, bytes, 104);
  if (core_hash(before, bytes + 112, all - 112) != core_get(bytes + 104, 8))
    return "the image was changed or half written";
  return NULL;
}

/* core_make_ray() of a ray in the mesh's own units. `length` counts directions. */
static inline bool core_make_mesh_ray(struct core_ray* ray, const struct core_image* image, const double origin[3],
                                      const float direction[3], float length) {
  float in_cube[3];
  for (int axis = 0; axis < 3; ++axis) in_cube[axis] = (float)((origin[axis] - image->offset[axis]) * image->scale);
  return core_make_ray(ray, in_cube, direction, (float)(length * image->scale));
}
/* The place of its hit: origin + distance direction. */
static inline double core_mesh_distance(const struct core_hit* hit, const struct core_image* image,
                                        const float direction[3]) {
  return core_distance(hit, direction) / image->scale;
}

/* Why an answer has failed. */
static inline const char* core_why(const struct core_hit* hit) {
  static const char* const why[] = {REASONS};
  return hit->failed < sizeof why / sizeof *why ? why[hit->failed] : "it is no answer";
}
)";

}  // namespace

std::string c_image(const Core& core) {
  std::string text(text_of_image);
  constexpr std::string_view place = "REASONS";
  text.replace(
      text.find(place), place.size(),
      fmt::format("\"{}\"", fmt::join(hls::failure_texts, "\",\n                                    \"")));
  return fmt::format(R"(
#define CORE_IMAGE_VERSION {}
#define CORE_HEADER_BYTES 128 /* with the record before the header */
#define CORE_COORD_BITS {} /* n of an image's grid */
#define CORE_LEVELS {} /* of records on a path */
#define CORE_NUMBER_BITS {} /* of a triangle's number; all ones is none */
#define CORE_LEAF_BITS {} /* of the number of triangles in a leaf; all ones is a record */
#define CORE_STEP_BITS {} /* of the number of records that a ray may test */
)",
                     hls::image_version, core.options.bits.coord, core.options.levels,
                     core.options.number_bits, core.options.leaf_bits, core.options.step_bits) +
         text;
}

}  // namespace hitpipe::rtl
