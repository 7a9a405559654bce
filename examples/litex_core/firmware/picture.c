/* A small picture by the core, as text: a processor without floats has time for it. */
#include "picture.h"

#include <stdio.h>

#include "driver.h"

enum { width = 32, height = 24, pixels = width * height }; /* a pixel's number is its ray's tag */

/* The camera of ../../core_system, worked out: the scene `spheres` in the image's cube. The direction is as
   long as it comes, and its part along the line of sight is one. */
static const float eye[3] = {0.054294752f, -0.0380063264f, 0.999023438f};
static const float ahead[3] = {-0.0513637309f, -0.254764105f, -0.96563814f};
static const float right[3] = {0.0147341114f, 0, -0.000783729329f};
static const float up[3] = {-0.000199666101f, 0.0142680752f, -0.0037537227f};

static void make_direction(float direction[3], int pixel) {
  const float x = (float)(2 * (pixel % width) + 1 - width);
  const float y = (float)(height - 1 - 2 * (pixel / width));
  for (int axis = 0; axis < 3; ++axis) direction[axis] = ahead[axis] + x * right[axis] + y * up[axis];
}

/* The nearer, the fuller. */
static char letter_of(const struct core_hit* hit, const float direction[3]) {
  static const char letters[] = "@%#*+=-:.";
  const int letter = (int)((core_distance(hit, direction) - 0.5) * 12);
  return letters[letter < 0 ? 0 : letter > 8 ? 8 : letter];
}

#if CORE_HAS_RINGS
static struct core_rings rings;
static const char* start_rays(uint64_t address) {
  return core_start_rings(&rings, address, address + PICTURE_PLACES * CORE_RAY_BYTES, PICTURE_PLACES);
}
static bool send(uint32_t tag, const struct core_ray* ray) {
  const bool sent = core_send(&rings, tag, ray);
  core_offer(&rings);
  return sent;
}
static bool take(uint32_t* tag, struct core_hit* hit) {
  return core_take(&rings, tag, hit);
}
#else
static const char* start_rays(uint64_t address) {
  (void)address;
  return NULL;
}
static bool send(uint32_t tag, const struct core_ray* ray) {
  return core_send(tag, ray);
}
static bool take(uint32_t* tag, struct core_hit* hit) {
  return core_take(tag, hit);
}
#endif

bool draw_picture(uint64_t address, uint64_t rings_address, const uint8_t* bytes, uint64_t size) {
  static char picture[pixels];
  static uint8_t answers[pixels];
  int sent = 0, taken = 0, hits = 0, failed = 0;
  struct core_image image;
  const char* refused = core_read_image(&image, bytes, size);
  if (!refused) refused = core_start(address, &image);
  if (!refused) refused = start_rays(rings_address);
  if (refused) {
    printf("%s\n", refused);
    return false;
  }
  for (long silent = 0; taken < pixels && silent < 100000; ++silent) {
    if (sent < pixels) {
      float direction[3];
      struct core_ray ray;
      make_direction(direction, sent);
      core_make_ray(&ray, eye, direction, __builtin_inff());
      if (send((uint32_t)sent, &ray)) ++sent;
    }
    uint32_t pixel;
    struct core_hit hit;
    while (take(&pixel, &hit)) {
      silent = 0;
      ++taken;
      if (pixel >= pixels) return false;
      ++answers[pixel];
      if (hit.failed && failed++ == 0) printf("pixel %u: %s\n", (unsigned)pixel, core_why(&hit));
      picture[pixel] = ' ';
      if (hit.failed || hit.number == CORE_NO_HIT) continue;
      ++hits;
      float direction[3];
      make_direction(direction, (int)pixel);
      picture[pixel] = letter_of(&hit, direction);
    }
  }
#if CORE_HAS_RINGS
  if (rings.wrong) printf("%s\n", rings.wrong);
#endif
  bool once = true;
  for (int pixel = 0; pixel < pixels; ++pixel) once = once && answers[pixel] == 1;
  for (int row = 0; row < height; ++row) printf("%.*s\n", width, picture + row * width);
  printf("%d answers, %d hits, %d failed\n", taken, hits, failed);
  /* The core has counted the same. */
  return once && failed == 0 && core_count(CORE_COUNT_RAYS) == pixels &&
         core_count(CORE_COUNT_ANSWERS) == pixels && core_count(CORE_COUNT_HITS) == (uint64_t)hits;
}
